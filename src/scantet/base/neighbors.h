// The cells of a grid that touch a cell.
#pragma once

#include <array>
#include <cstddef>

#include "scantet/base/geometry.h"

namespace scantet {

/// From a cell of a grid to one that touches it, in cells: coordinates of -1, 0 and 1.
using NeighborOffset = std::array<int, 3>;

/// The offsets of the 26 cells that touch a cell and of the cell itself, {0, 0, 0}, which is in the middle of them; x
/// changes fastest, then y.
inline constexpr std::array<NeighborOffset, 27> kNeighborhood = [] {
  std::array<NeighborOffset, 27> offsets{};
  std::size_t n = 0;
  for (int z = -1; z <= 1; ++z) {
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) offsets[n++] = {x, y, z};
    }
  }
  return offsets;
}();

/// The same as a direction.
inline Vec as_vec(const NeighborOffset& offset) {
  return {static_cast<double>(offset[0]), static_cast<double>(offset[1]), static_cast<double>(offset[2])};
}

/// A node's neighbour along an axis. direction: 0 … 5, down and up along x, y, z.
inline std::array<int, 3> axis_neighbor(std::array<int, 3> node, int direction) {
  node[static_cast<std::size_t>(direction / 2)] += direction % 2 == 0 ? -1 : 1;
  return node;
}

/// The directions to the 26 cells that touch a cell, in the order of kNeighborhood; of lengths from 1 to √3.
inline constexpr std::array<Vec, 26> kNeighborDirections = [] {
  std::array<Vec, 26> directions{};
  std::size_t n = 0;
  for (const NeighborOffset& offset : kNeighborhood) {
    if (offset == NeighborOffset{0, 0, 0}) continue;
    directions[n++] = {static_cast<double>(offset[0]), static_cast<double>(offset[1]), static_cast<double>(offset[2])};
  }
  return directions;
}();

}  // namespace scantet
