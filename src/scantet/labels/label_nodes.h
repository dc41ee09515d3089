// The labels of a padded grid in 8 or 16 bits, and which blocks of its cells hold one label only.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scantet/field/block_signs.h"
#include "scantet/field/cell_walk.h"

namespace scantet {

/// A label's place among the regions of a LabelField, ascending.
using LabelRank = std::uint16_t;

/// The ranks at the nodes of a grid with one node of padding, rank 0, around it. Blocks of cells are those of
/// block_signs.h. Memory: one byte a node for up to 256 ranks, else two, and 4 % of a byte a node for the blocks.
class LabelNodes {
 public:
  LabelNodes() = default;
  /// Padding only. size: nodes along each axis without the padding; ranks: how many there are.
  LabelNodes(const std::array<int, 3>& size, std::size_t ranks);

  /// Sets the ranks of a row of nodes, of which there are size()[0], not padding. Other rows may be set meanwhile.
  void set_row(int j, int k, const LabelRank* ranks);
  /// Finds the blocks; to be called once all rows are set, and before the questions about cells.
  void find_blocks();

  const std::array<int, 3>& size() const { return size_; }
  /// -1 ≤ i ≤ size()[0], and so on.
  LabelRank at(int i, int j, int k) const { return at(position(i, j, k)); }
  /// The ranks at the corners of a cell; bit 0 of the place is x, bit 1 y, bit 2 z.
  std::array<LabelRank, 8> corners(const CellIndex& cell) const {
    const std::size_t first = position(cell[0], cell[1], cell[2]);
    return {at(first),          at(first + 1),          at(first + row_),          at(first + row_ + 1),
            at(first + layer_), at(first + layer_ + 1), at(first + layer_ + row_), at(first + layer_ + row_ + 1)};
  }

  /// Whether the block of 2³ (8³, 32³) cells that holds the cell has nodes of several labels.
  bool small_is_mixed(const CellIndex& cell) const {
    const auto part = [&](int axis) { return (cell[axis] + 1) >> kSmallShift & 3; };
    return mixed_[fine_position(cell)] >> (part(0) | part(1) << 2 | part(2) << 4) & 1;
  }
  bool fine_is_mixed(const CellIndex& cell) const { return mixed_[fine_position(cell)] != 0; }
  bool coarse_is_mixed(const CellIndex& cell) const { return coarse_mixed_[coarse_position(cell)] != 0; }
  /// Whether a small block that a box of cells touches is mixed; true if the box touches more than two fine blocks
  /// along an axis. a, b: cells at opposite corners of the box.
  bool mixed_between(const CellIndex& a, const CellIndex& b) const;

  /// Fine blocks along each axis.
  const std::array<int, 3>& block_counts() const { return fine_counts_; }

 private:
  LabelRank at(std::size_t position) const { return narrow_.empty() ? wide_[position] : narrow_[position]; }
  std::size_t position(int i, int j, int k) const {
    return static_cast<std::size_t>(k + 1) * layer_ + static_cast<std::size_t>(j + 1) * row_ +
           static_cast<std::size_t>(i + 1);
  }
  std::size_t fine_position(const CellIndex& cell) const {
    const auto block = [&](int axis) { return static_cast<std::size_t>(cell[axis] + 1) >> kFineShift; };
    return (block(2) * fine_counts_[1] + block(1)) * fine_counts_[0] + block(0);
  }
  std::size_t coarse_position(const CellIndex& cell) const {
    const auto block = [&](int axis) { return static_cast<std::size_t>(cell[axis] + 1) >> kCoarseShift; };
    return (block(2) * coarse_counts_[1] + block(1)) * coarse_counts_[0] + block(0);
  }
  template <class Rank>
  std::uint64_t mixed_in_block(const std::vector<Rank>& ranks, int x, int y, int z) const;

  std::array<int, 3> size_{};
  std::size_t row_ = 0;    // nodes of a row, padding among them
  std::size_t layer_ = 0;  // of a layer
  std::vector<std::uint8_t> narrow_;
  std::vector<std::uint16_t> wide_;  // one of the two is empty
  std::array<int, 3> fine_counts_{};
  std::array<int, 3> coarse_counts_{};
  std::vector<std::uint64_t> mixed_;  // by fine block: bit x + 4·y + 16·z is small block (x, y, z)
  std::vector<std::uint8_t> coarse_mixed_;
};

/// Calls act(i, j, k) for each cell of layer k where labels meet.
template <class Act>
void for_each_mixed_cell(const LabelNodes& nodes, int k, const Act& act) {
  const std::array<int, 3>& size = nodes.size();
  for (int j = -1; j < size[1]; ++j) {
    for (int i = -1; i < size[0]; ++i) {
      if (!nodes.coarse_is_mixed({i, j, k})) {
        i = std::min(size[0], ((i + 1) >> kCoarseShift << kCoarseShift) + (1 << kCoarseShift) - 2);
      } else if (!nodes.fine_is_mixed({i, j, k})) {
        i = std::min(size[0], ((i + 1) >> kFineShift << kFineShift) + (1 << kFineShift) - 2);
      } else if (nodes.small_is_mixed({i, j, k})) {
        const auto corners = nodes.corners({i, j, k});
        if (std::any_of(corners.begin(), corners.end(), [&](LabelRank rank) { return rank != corners[0]; })) {
          act(i, j, k);
        }
      }
    }
  }
}

}  // namespace scantet
