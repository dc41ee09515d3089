// A grid of heights whose nodes may change sides.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "scantet/base/neighbors.h"
#include "scantet/field/height_grid.h"
#include "scantet/topology/cell_euler.h"

namespace scantet {

/// The nodes of a grid with those of its padding, numbered from 0, x fastest; cell n has node n for its low corner.
struct PaddedNodes {
  std::array<int, 3> size{};  ///< without the padding

  std::int64_t count() const { return std::int64_t{size[0] + 2} * (size[1] + 2) * (size[2] + 2); }
  /// What is added to a node's number for the next along an axis.
  std::int64_t step(int axis) const {
    return axis == 0 ? 1 : axis == 1 ? size[0] + 2 : std::int64_t{size[0] + 2} * (size[1] + 2);
  }
  /// What is added to it for the node that is so far away along the axes.
  std::int64_t step(const NeighborOffset& offset) const {
    return offset[0] + offset[1] * step(1) + offset[2] * step(2);
  }
  /// What is added to a cell's number for its corner c.
  std::int64_t corner_step(int c) const { return (c & 1) + (c >> 1 & 1) * step(1) + (c >> 2) * step(2); }
  std::int64_t number(const std::array<int, 3>& node) const {
    return (node[2] + 1) * step(2) + (node[1] + 1) * step(1) + node[0] + 1;
  }
  std::array<int, 3> node(std::int64_t number) const {
    const std::int64_t row = number / step(1);
    return {static_cast<int>(number % step(1)) - 1, static_cast<int>(row % (size[1] + 2)) - 1,
            static_cast<int>(row / (size[1] + 2)) - 1};
  }
  bool is_padding(const std::array<int, 3>& node) const {
    bool is = false;
    for (int axis = 0; axis < 3; ++axis) is = is || node[axis] < 0 || node[axis] >= size[axis];
    return is;
  }
};

/// Of which side each node is, in one byte a node. Nodes at the level are taken for nodes a little below it, so that
/// there are no ties; a saddle of a face at the level itself counts as below it.
class SidedNodes {
 public:
  /// Gives the height on the other side that a node of this height gets when it changes sides.
  using OtherHeight = std::function<double(double)>;

  /// heights: kept by reference.
  SidedNodes(const HeightGrid& heights, OtherHeight other)
      : heights_(heights), other_(std::move(other)), nodes_{heights.size()}, little_(little_below(heights)) {
    flags_.resize(static_cast<std::size_t>(nodes_.count()));
    std::size_t n = 0;
    for (int k = -1; k <= nodes_.size[2]; ++k) {
      for (int j = -1; j <= nodes_.size[1]; ++j) {
        for (int i = -1; i <= nodes_.size[0]; ++i) flags_[n++] = heights.height(i, j, k) > 0 ? kInside | kWasInside : 0;
      }
    }
  }

  const PaddedNodes& nodes() const { return nodes_; }
  const HeightGrid& heights() const { return heights_; }
  bool inside(std::int64_t n) const { return (flags_[n] & kInside) != 0; }
  bool is_turned(std::int64_t n) const { return ((flags_[n] ^ flags_[n] >> 1) & kInside) != 0; }
  /// Has the node change sides. Pre: it is not of the padding.
  void turn(std::int64_t n) { flags_[n] ^= kInside; }

  /// The height of a node where it is now; never 0. node: of number n.
  double height(std::int64_t n, const std::array<int, 3>& node) const { return height(is_turned(n), node); }
  /// What that becomes if the node changes sides.
  double turned_height(std::int64_t n, const std::array<int, 3>& node) const { return height(!is_turned(n), node); }
  /// Which corners of a cell are inside.
  unsigned pattern(std::int64_t cell) const {
    const std::int64_t dy = nodes_.step(1);
    const std::int64_t dz = nodes_.step(2);
    const auto bit = [&](std::int64_t n) { return unsigned{flags_[n]} & kInside; };
    return bit(cell) | bit(cell + 1) << 1 | bit(cell + dy) << 2 | bit(cell + dy + 1) << 3 | bit(cell + dz) << 4 |
           bit(cell + dz + 1) << 5 | bit(cell + dz + dy) << 6 | bit(cell + dz + dy + 1) << 7;
  }
  /// What a cell joins, as it is now.
  CellParts parts(std::int64_t cell) const {
    const std::array<int, 3> low = nodes_.node(cell);
    CellHeights heights;
    for (int c = 0; c < 8; ++c) {
      const std::int64_t n = cell + nodes_.corner_step(c);
      heights[c] = height(n, {low[0] + (c & 1), low[1] + (c >> 1 & 1), low[2] + (c >> 2)});
    }
    return cell_parts(pattern(cell), heights);
  }

 private:
  static constexpr std::uint8_t kInside = 1;
  static constexpr std::uint8_t kWasInside = 2;

  double height(bool turned, const std::array<int, 3>& node) const {
    const double as_read = heights_.height(node[0], node[1], node[2]);
    const double h = turned ? other_(as_read) : as_read;
    return h != 0 ? h : -little_;
  }

  const HeightGrid& heights_;
  OtherHeight other_;
  PaddedNodes nodes_;
  double little_;
  std::vector<std::uint8_t> flags_;
};

}  // namespace scantet
