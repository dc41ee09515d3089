// Voxels whose value is the level itself, as scans of whole numbers have at whole levels.
#pragma once

#include <cstdint>

#include "scantet/field/level_settings.h"
#include "scantet/field/scan.h"

namespace scantet {

/// Voxels at the level, which count as outside: the level set passes through their centres.
struct ValuesAtLevel {
  std::int64_t voxels = 0;
  /// Those of them that have, along an axis of the grid, the inside on both sides: the outside has no width there, so
  /// that no mesh can show it.
  std::int64_t gaps = 0;
  /// A level that no voxel has as its value, and hardly any saddle between whole numbers, and that puts each voxel on
  /// the side it is on: 0.38 of the way to the nearest value on the inside. The level itself if voxels is 0.
  double clear_level = 0;
};

/// Looks at every voxel once. Pre: the level parts the values of the scan, as check_level() has it.
ValuesAtLevel values_at_level(const Scan& scan, double level, InsideSide side);

}  // namespace scantet
