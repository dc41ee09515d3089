// The node that a point of a trilinear field belongs to, by a walk along the grid.
#pragma once

#include <array>
#include <cmath>

#include "scantet/field/padded_grid.h"

namespace scantet::test {

/// The node that one gets to from p (voxel units) by going along the axes, in that order, each time to the higher end
/// of the edge. direction: 1, or -1 to go to the lower end.
inline std::array<int, 3> node_reached(const PaddedGrid<float>& grid, Vec p, const std::array<int, 3>& axes,
                                       double direction = 1) {
  const auto height = [&](const Vec& at) {
    const CellIndex cell = cell_of(at, grid.size);
    return direction * trilinear(grid.corners(cell[0], cell[1], cell[2]), local_in(cell, at));
  };
  for (const int axis : axes) {
    Vec low = p;
    Vec high = p;
    low[axis] = std::floor(p[axis]);
    high[axis] = std::floor(p[axis]) + 1;
    p = height(high) > height(low) ? high : low;
  }
  return {static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.z)};
}

}  // namespace scantet::test
