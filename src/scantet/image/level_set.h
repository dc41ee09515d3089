// A level set of a scan as a domain: the field is trilinear between voxel centres.
#pragma once

#include <memory>
#include <optional>

#include "scantet/base/api.h"
#include "scantet/base/progress.h"
#include "scantet/domain/domain.h"
#include "scantet/field/level_settings.h"
#include "scantet/field/scan.h"

namespace SCANTET_API scantet {

/// The open set where the trilinear interpolant of the scan is on the inside of the level; region 1.
///
/// The field continues from the outermost voxel centres to `settings.outside` over one voxel and is outside beyond, so
/// the boundary is closed. Queries take world mm (docs/architecture.md, "Who knows what").
/// scan: its voxels are not copied; the domain keeps Scan::owner, and so should keep them alive. Return: null if
/// progress.cancelled() became true.
/// Throws Error: input.level (as check_level()), usage.outside (the outside value is on the inside of the level, or
/// more than 1000 times the scan's value range off it). Guarantees: every crossing satisfies |f - level| ≤ 1e-9 of the
/// scan's value range; all crossings are found; components() and size_hints() are those of the trilinear field, not of
/// a voxel count. Memory beyond the voxels: at most 15 % of them, and 160 bytes a component. Sweeps the scan for its
/// topology at once, on the threads of with_threads(); afterwards nothing is locked, and only surface_candidates(),
/// size_hints(), narrow_ways() and misplaced() start threads.
std::unique_ptr<Domain> make_level_set(const Scan& scan, const LevelSetSettings& settings,
                                       const Progress& progress = Progress());

/// The settings that make_level_set() works with: the outside value is given, and strictly on the outside of the level.
/// One at the level is put a thousandth of the scan's value range off it. Throws Error: as make_level_set().
LevelSetSettings checked_settings(const Scan& scan, LevelSetSettings settings);

}  // namespace scantet
