// What a scan has at the level itself: voxels, as scans of whole numbers have at whole levels, and saddles, as masks
// have half way.
#pragma once

#include <cstdint>

#include "scantet/base/api.h"
#include "scantet/field/level_settings.h"
#include "scantet/field/scan.h"

namespace SCANTET_API scantet {

/// Voxels at the level count as outside: the level set passes through their centres.
struct ValuesAtLevel {
  std::int64_t voxels = 0;
  /// Those of them that have, along an axis of the grid, the inside on both sides: the outside has no width there, so
  /// that no mesh can show it.
  std::int64_t gaps = 0;
  /// Faces between four voxel centres, two of them inside, across from each other, whose saddle is at the level: there
  /// the level set touches itself at a point, and is no surface.
  std::int64_t saddles = 0;
  /// A level that puts each voxel on the side it is on. If there are voxels at the level, one that no voxel has as its
  /// value, and hardly any saddle between whole numbers: 0.38 of the way to the nearest value on the inside. Else, if
  /// there are saddles, one on the inside that is as near as leaves the parts of the mean saddle a fifth of a voxel
  /// apart, and no farther than 0.24 of that way. Else the level itself.
  double clear_level = 0;
};

/// Looks at every voxel once. Pre: the level parts the values of the scan, as check_level() has it.
ValuesAtLevel values_at_level(const Scan& scan, double level, InsideSide side);

}  // namespace scantet
