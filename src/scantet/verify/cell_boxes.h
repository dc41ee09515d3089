// Cells one by one, and boxes within them.
#pragma once

#include <algorithm>
#include <utility>

#include "scantet/verify/voxel_nodes.h"

namespace scantet::verify {

/// The cell as a box, index coordinates.
inline Box whole_cell(const Cell& cell) {
  return {{double(cell[0]), double(cell[1]), double(cell[2])}, {cell[0] + 1.0, cell[1] + 1.0, cell[2] + 1.0}};
}

/// One of the eight parts of a box.
inline Box eighth(const Box& box, int n) {
  const Point middle = box.center();
  Box part = box;
  for (int axis = 0; axis < 3; ++axis) (n >> axis & 1 ? part.min : part.max)[axis] = middle[axis];
  return part;
}

/// Whether the field may be zero where it has that range.
inline bool may_hold_level(const Interval& range) {
  return range.lo <= 0 && range.hi >= 0;
}

/// Calls visit(cell, lowest, highest) for the cells of a layer, with the signs of their corners.
template <class Visit>
void for_cells_of_layer(const VoxelNodes& nodes, int k, const Visit& visit) {
  for (int j = -1; j < nodes.size()[1]; ++j) {
    const auto signs_at = [&](int i) {
      return std::minmax(
          {nodes.sign(i, j, k), nodes.sign(i, j + 1, k), nodes.sign(i, j, k + 1), nodes.sign(i, j + 1, k + 1)});
    };
    std::pair<int, int> left = signs_at(-1);
    for (int i = -1; i < nodes.size()[0]; ++i) {
      const std::pair<int, int> right = signs_at(i + 1);
      visit(Cell{i, j, k}, std::min(left.first, right.first), std::max(left.second, right.second));
      left = right;
    }
  }
}

}  // namespace scantet::verify
