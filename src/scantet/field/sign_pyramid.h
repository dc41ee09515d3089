// Which blocks of a dense grid's cells lie wholly on one side of the level.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scantet/base/parallel.h"
#include "scantet/field/block_signs.h"
#include "scantet/field/padded_grid.h"

namespace scantet {

/// What the nodes of blocks of cells, padding among them, say about the level: for blocks of 2³, 8³ and 32³ cells. A
/// block is uniform if all its nodes (3³, 9³, 33³) are on one side. Each block of 2³, also one that the grid has a part
/// of only, takes two bits, which are kept by block of 8³, so that one cache line answers for a neighbourhood. Memory:
/// about 3 % of an 8-bit scan.
class SignPyramid {
 public:
  SignPyramid() = default;
  template <class Voxel>
  explicit SignPyramid(const PaddedGrid<Voxel>& grid);

  /// The sign of the block of 2^kSmallShift (2^kFineShift, 2^kCoarseShift) cells a side that holds the cell.
  BlockSign small(const CellIndex& cell) const { return fine_[fine_counts_.position(cell, kFineShift)].small(cell); }
  BlockSign fine(const CellIndex& cell) const { return fine_[fine_counts_.position(cell, kFineShift)].whole(); }
  BlockSign coarse(const CellIndex& cell) const { return coarse_[coarse_counts_.position(cell, kCoarseShift)]; }

  /// The sign of all cells in a box, as sign_between() has it.
  BlockSign between(const CellIndex& a, const CellIndex& b) const {
    return sign_between(
        a, b, [this](int x, int y, int z) -> const BlockSigns& { return fine_[fine_counts_.position(x, y, z)]; });
  }

  /// Fine blocks along each axis.
  const std::array<int, 3>& block_counts() const { return fine_counts_.counts; }

 private:
  struct Counts {
    std::array<int, 3> counts{};

    Counts() = default;
    Counts(const std::array<int, 3>& size, int shift) {
      for (int axis = 0; axis < 3; ++axis) counts[axis] = (size[axis] >> shift) + 1;
    }
    std::size_t total() const { return static_cast<std::size_t>(counts[0]) * counts[1] * counts[2]; }
    std::size_t position(int x, int y, int z) const {
      return (static_cast<std::size_t>(z) * counts[1] + y) * counts[0] + x;
    }
    std::size_t position(const CellIndex& cell, int shift) const {
      return position((cell[0] + 1) >> shift, (cell[1] + 1) >> shift, (cell[2] + 1) >> shift);
    }
  };

  template <class Voxel>
  void build_fine(const PaddedGrid<Voxel>& grid, int z);
  /// Keeps the signs of one layer of small blocks: of layer `part` (0 … 3) of the four that the layer z of fine blocks
  /// has. any, all: for each position of a row, whether some (all) of the 3 × 3 nodes there, of the block's rows and
  /// layers, are inside.
  void keep_small_blocks(const std::vector<std::uint64_t>& any, const std::vector<std::uint64_t>& all, int z, int part);
  void build_coarse();

  Counts fine_counts_;
  Counts coarse_counts_;
  std::vector<BlockSigns> fine_;
  std::vector<BlockSign> coarse_;
};

template <class Voxel>
SignPyramid::SignPyramid(const PaddedGrid<Voxel>& grid)
    : fine_counts_(grid.size, kFineShift),
      coarse_counts_(grid.size, kCoarseShift),
      fine_(fine_counts_.total()),
      coarse_(coarse_counts_.total()) {
  parallel_for(fine_counts_.counts[2], 1, [&](std::size_t z, std::size_t) { build_fine(grid, static_cast<int>(z)); });
  build_coarse();
}

/// Works out one layer of fine blocks. Rows of nodes are bits: the rows and layers of a small block are joined first,
/// then neighbours along x, 64 nodes at a time.
template <class Voxel>
void SignPyramid::build_fine(const PaddedGrid<Voxel>& grid, int z) {
  constexpr int kSide = 1 << kFineShift;
  const std::size_t words = grid.row_words();
  const std::size_t rows = std::size_t{4} * fine_counts_.counts[1];  // of small blocks
  std::vector<std::uint64_t> nodes((2 * rows + 1) * words);
  std::vector<std::uint64_t> any;
  std::vector<std::uint64_t> all;
  const auto join = [&] {
    for (std::size_t at = 0; at < rows * words; ++at) {
      const std::size_t n = at + at / words * words;  // two rows of nodes for one of blocks
      any[at] |= nodes[n] | nodes[n + words] | nodes[n + 2 * words];
      all[at] &= nodes[n] & nodes[n + words] & nodes[n + 2 * words];
    }
  };
  for (int k = 0; k <= kSide; ++k) {
    for (std::size_t row = 0; row <= 2 * rows; ++row) {
      grid.row_signs(static_cast<int>(row) - 1, z * kSide + k - 1, &nodes[row * words]);
    }
    if (k > 0) join();
    if (k % 2 == 1) continue;
    if (k > 0) keep_small_blocks(any, all, z, k / 2 - 1);
    any.assign(rows * words, 0);
    all.assign(rows * words, ~std::uint64_t{0});
    join();
  }
}

}  // namespace scantet
