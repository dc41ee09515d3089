// A level set of a sparse grid as a domain.
#pragma once

#include <memory>

#include "scantet/domain/domain.h"
#include "scantet/field/values_at_level.h"
#include "scantet/image/level_set.h"
#include "vdb_grid.h"

namespace vdb {

/// As scantet::values_at_level() of the voxels in the grid's box. Throws Error: as make_domain().
scantet::ValuesAtLevel values_at_level(const Grid& grid, double level, scantet::InsideSide side,
                                       const scantet::Progress& progress = scantet::Progress());

/// The open set where the trilinear interpolant of the grid is on the inside of the level; region 1. The background
/// plays the part of the image's outside value: settings.outside is not looked at. Throws Error(Fault::input):
/// input.level (nothing or everything is inside), input.background (the background is not on the outside of the level).
/// Guarantees: as make_level_set(). Null if progress.cancelled() became true.
std::unique_ptr<scantet::Domain> make_domain(const Grid& grid, const scantet::LevelSetSettings& settings,
                                             const scantet::Progress& progress = scantet::Progress());

}  // namespace vdb
