// On which side of the level blocks of cells lie, so that queries can skip those of one side.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "scantet/base/api.h"
#include "scantet/field/cell_walk.h"

namespace SCANTET_API scantet {

/// What is known of the nodes of a block of cells. inside: all are above the level; outside: none is; mixed: there may
/// be both.
enum class BlockSign : std::uint8_t { mixed, inside, outside };

/// Blocks of cells come in three sizes: small ones of 2³ cells, fine ones of 8³ and coarse ones of 32³. Along an axis,
/// block b of s cells a side holds the cells from s·b - 1 to s·b + s - 2, or as many of them as the grid has.
inline constexpr int kSmallShift = 1;
inline constexpr int kFineShift = 3;
inline constexpr int kCoarseShift = 5;

/// What the nodes of a fine block say about the level, by small blocks: bit x + 4·y + 16·z is small block (x, y, z). A
/// small block is uniform if its 3³ nodes are on one side. Small blocks beyond the grid are outside, as the padding
/// beside them is.
struct BlockSigns {
  std::uint64_t mixed = 0;   ///< those that are not uniform
  std::uint64_t inside = 0;  ///< those that are uniform and inside; the others are outside

  /// The sign of the whole block.
  BlockSign whole() const {
    if (mixed != 0) return BlockSign::mixed;
    return inside != 0 ? BlockSign::inside : BlockSign::outside;  // neighbours share nodes, so all are alike
  }
  /// The sign of the small block that holds the cell. Pre: the cell is in this block.
  BlockSign small(const CellIndex& cell) const {
    const auto part = [&](int axis) { return (cell[axis] + 1) >> kSmallShift & 3; };
    const int bit = part(0) | part(1) << 2 | part(2) << 4;
    if (mixed >> bit & 1) return BlockSign::mixed;
    return inside >> bit & 1 ? BlockSign::inside : BlockSign::outside;
  }
};

/// The sign of all cells in the box that has the cells a and b at opposite corners, by the small blocks that it
/// touches. A box that touches more than two fine blocks along an axis counts as mixed. a, b: cells of the padded grid,
/// from -1 to size - 1 along each axis. block_at(x, y, z): the BlockSigns of fine block (x, y, z), x, y, z ≥ 0.
template <class BlockAt>
BlockSign sign_between(const CellIndex& a, const CellIndex& b, const BlockAt& block_at) {
  constexpr std::uint64_t kAll = ~std::uint64_t{0};
  constexpr std::array<std::uint64_t, 3> kRepeat{0x1111111111111111, 0x0001000100010001, 1};
  constexpr std::array<std::uint64_t, 3> kPattern{0xF, 0xFFFF, kAll};
  std::array<int, 3> first;
  std::array<int, 3> last;
  std::array<std::array<std::uint64_t, 2>, 3> masks;  // of the small blocks in the first and the last fine block
  for (int axis = 0; axis < 3; ++axis) {
    const int low = (std::min(a[axis], b[axis]) + 1) >> kSmallShift;
    const int high = (std::max(a[axis], b[axis]) + 1) >> kSmallShift;
    const int width = 1 << 2 * axis;
    first[axis] = low >> 2;
    last[axis] = high >> 2;
    if (last[axis] - first[axis] > 1) return BlockSign::mixed;
    const std::uint64_t from = kPattern[axis] << width * (low & 3) & kPattern[axis];
    const std::uint64_t to = kPattern[axis] >> width * (3 - (high & 3));
    masks[axis][0] = kRepeat[axis] * (first[axis] == last[axis] ? from & to : from);
    masks[axis][1] = kRepeat[axis] * to;
  }
  std::uint64_t not_outside = 0;
  std::uint64_t not_inside = 0;
  for (int z = first[2]; z <= last[2]; ++z) {
    for (int y = first[1]; y <= last[1]; ++y) {
      const std::uint64_t rows = masks[2][z - first[2]] & masks[1][y - first[1]];
      for (int x = first[0]; x <= last[0]; ++x) {
        const BlockSigns& block = block_at(x, y, z);
        const std::uint64_t mask = rows & masks[0][x - first[0]];
        not_outside |= (block.mixed | block.inside) & mask;
        not_inside |= (block.mixed | ~block.inside) & mask;
      }
    }
    if (not_outside != 0 && not_inside != 0) return BlockSign::mixed;
  }
  return not_inside == 0 ? BlockSign::inside : BlockSign::outside;
}

}  // namespace scantet
