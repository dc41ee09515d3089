// Which blocks of cells lie wholly on one side of the level, so that queries can skip them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "scantet/image/cell_walk.h"
#include "scantet/image/padded_grid.h"

namespace scantet {

enum class BlockSign : std::uint8_t { mixed, inside, outside };

/// What the min-max range of each block of the padded grid says about the level. The level is fixed, so the answer is
/// kept in place of the range: one byte for 8³ cells (9³ nodes, the padding among them) and one for 32³. Memory: one
/// byte for each started block, 0.2 % of an 8-bit scan.
class SignPyramid {
 public:
  static constexpr int kFineShift = 3;
  static constexpr int kCoarseShift = 5;

  SignPyramid() = default;
  template <class Voxel>
  explicit SignPyramid(const PaddedGrid<Voxel>& grid);

  /// Of the block of 2^kFineShift (2^kCoarseShift) cells a side that holds the cell.
  BlockSign fine(const CellIndex& cell) const { return sign_in(fine_, cell, kFineShift); }
  BlockSign coarse(const CellIndex& cell) const { return sign_in(coarse_, cell, kCoarseShift); }

  /// Fine blocks along each axis. Block b holds the cells from 8·b - 1 to 8·b + 6, as far as the grid goes.
  const std::array<int, 3>& block_counts() const { return fine_.counts; }

 private:
  struct Level {
    std::array<int, 3> counts{};
    std::vector<BlockSign> signs;

    Level() = default;
    Level(const std::array<int, 3>& cells, int shift) {
      for (int axis = 0; axis < 3; ++axis) counts[axis] = ((cells[axis] - 1) >> shift) + 1;
      signs.resize(static_cast<std::size_t>(counts[0]) * counts[1] * counts[2], BlockSign::mixed);
    }
    std::size_t position(int x, int y, int z) const {
      return (static_cast<std::size_t>(z) * counts[1] + y) * counts[0] + x;
    }
  };

  static BlockSign sign_in(const Level& level, const CellIndex& cell, int shift) {
    return level.signs[level.position((cell[0] + 1) >> shift, (cell[1] + 1) >> shift, (cell[2] + 1) >> shift)];
  }
  template <class Voxel>
  static BlockSign sign_of_nodes(const PaddedGrid<Voxel>& grid, const std::array<int, 3>& first,
                                 const std::array<int, 3>& last);
  void build_coarse(const std::array<int, 3>& cells);

  Level fine_;
  Level coarse_;
};

template <class Voxel>
SignPyramid::SignPyramid(const PaddedGrid<Voxel>& grid) {
  const std::array<int, 3> cells{grid.size[0] + 1, grid.size[1] + 1, grid.size[2] + 1};
  fine_ = Level(cells, kFineShift);
  std::size_t position = 0;
  for (int z = 0; z < fine_.counts[2]; ++z) {
    for (int y = 0; y < fine_.counts[1]; ++y) {
      for (int x = 0; x < fine_.counts[0]; ++x) {
        const std::array<int, 3> block{x, y, z};
        std::array<int, 3> first;
        std::array<int, 3> last;
        for (int axis = 0; axis < 3; ++axis) {
          first[axis] = (block[axis] << kFineShift) - 1;
          last[axis] = std::min(first[axis] + (1 << kFineShift), grid.size[axis]);
        }
        fine_.signs[position++] = sign_of_nodes(grid, first, last);
      }
    }
  }
  build_coarse(cells);
}

template <class Voxel>
BlockSign SignPyramid::sign_of_nodes(const PaddedGrid<Voxel>& grid, const std::array<int, 3>& first,
                                     const std::array<int, 3>& last) {
  bool any_inside = false;
  bool any_outside = false;
  std::array<int, 3> low;
  std::array<int, 3> high;
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = std::max(first[axis], 0);
    high[axis] = std::min(last[axis], grid.size[axis] - 1);
    any_outside = any_outside || low[axis] != first[axis] || high[axis] != last[axis];  // the padding is outside
  }
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      const Voxel* row = grid.voxels + grid.offset(0, j, k);
      for (int i = low[0]; i <= high[0]; ++i) {
        const bool inside = grid.sign * (static_cast<double>(row[i]) - grid.level) > 0;
        any_inside |= inside;
        any_outside |= !inside;
      }
    }
    if (any_inside && any_outside) return BlockSign::mixed;
  }
  return any_inside ? BlockSign::inside : BlockSign::outside;
}

inline void SignPyramid::build_coarse(const std::array<int, 3>& cells) {
  constexpr int kShift = kCoarseShift - kFineShift;
  coarse_ = Level(cells, kCoarseShift);
  std::vector<bool> seen(coarse_.signs.size());
  std::size_t position = 0;
  for (int z = 0; z < fine_.counts[2]; ++z) {
    for (int y = 0; y < fine_.counts[1]; ++y) {
      for (int x = 0; x < fine_.counts[0]; ++x) {
        const BlockSign sign = fine_.signs[position++];
        const std::size_t parent = coarse_.position(x >> kShift, y >> kShift, z >> kShift);
        coarse_.signs[parent] = !seen[parent] || coarse_.signs[parent] == sign ? sign : BlockSign::mixed;
        seen[parent] = true;
      }
    }
  }
}

}  // namespace scantet
