// A level set of a scan as a domain: the field is trilinear between voxel centres.
#pragma once

#include <memory>
#include <optional>

#include "scantet/base/progress.h"
#include "scantet/domain/domain.h"
#include "scantet/image/scan.h"

namespace scantet {

enum class InsideSide { above, below };

/// Which level set, and how it closes at the border of the image.
struct LevelSetSettings {
  double level = 0;                       ///< in the units of the voxel values
  InsideSide inside = InsideSide::above;  ///< inside is value > level, or value < level
  /// Value of the field one voxel beyond the outermost voxel centres; must be on the outside of the level. Default: the
  /// smallest value of the scan (the largest with InsideSide::below).
  std::optional<double> outside;
};

/// Checks that the level parts values that run from min_value to max_value. Throws Error: input.level (nothing or
/// everything is inside: the message gives the range).
void check_level(double min_value, double max_value, const LevelSetSettings& settings);

/// The open set where the trilinear interpolant of the scan is on the inside of the level; region 1.
///
/// The field continues from the outermost voxel centres to `settings.outside` over one voxel and is outside beyond, so
/// the boundary is closed. Queries take world mm (DESIGN: the oracle).
/// Throws Error: as check_level(), usage.outside (the outside value is not on the outside of the level). Guarantees:
/// every crossing satisfies |f - level| ≤ 1e-9 of the scan's value range; all crossings are found; components() and
/// features() are those of the trilinear field, not of a voxel count. Memory beyond the voxels: at most 15 % of them.
/// Sweeps the scan for its topology at once, on the threads of with_threads(); afterwards nothing is locked, and only
/// surface_candidates() and features() start threads. Null if progress.cancelled() became true.
std::unique_ptr<Domain> make_level_set(const Scan& scan, const LevelSetSettings& settings,
                                       const Progress& progress = Progress());

/// The settings that make_level_set() works with: the outside value is given, and strictly on the outside of the level.
/// Throws as make_level_set().
LevelSetSettings checked_settings(const Scan& scan, LevelSetSettings settings);

}  // namespace scantet
