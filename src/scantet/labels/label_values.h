// Values of fields at the nodes where labels meet.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scantet/labels/label_nodes.h"

namespace scantet {

/// Some of the nodes of a padded grid, numbered in the order of their positions. Memory: 3/16 of a byte for each node
/// of the grid.
class NodeSet {
 public:
  NodeSet() = default;
  /// Empty. size: of the grid without its padding.
  explicit NodeSet(const std::array<int, 3>& size);

  /// Position of a node of the grid or its padding.
  std::size_t position(int i, int j, int k) const {
    return (static_cast<std::size_t>(k + 1) * rows_ + static_cast<std::size_t>(j + 1)) * row_ +
           static_cast<std::size_t>(i + 1);
  }
  /// Its inverse.
  std::array<int, 3> node_at(std::size_t position) const {
    const std::size_t line = position / row_;
    return {static_cast<int>(position % row_) - 1, static_cast<int>(line % rows_) - 1,
            static_cast<int>(line / rows_) - 1};
  }
  void insert(std::size_t position) { bits_[position / 64] |= std::uint64_t{1} << position % 64; }
  bool holds(std::size_t position) const { return bits_[position / 64] >> position % 64 & 1; }
  /// To be called after the last insert(), before the questions below.
  void number();
  /// How many nodes it holds.
  std::size_t count() const { return count_; }
  /// The number of a node that it holds.
  std::size_t number_of(std::size_t position) const {
    const std::uint64_t below = bits_[position / 64] & ((std::uint64_t{1} << position % 64) - 1);
    return before_[position / 64] + static_cast<std::size_t>(std::popcount(below));
  }
  /// The positions of all, ascending.
  std::vector<std::size_t> positions() const;

 private:
  std::size_t row_ = 0;   // nodes of a row
  std::size_t rows_ = 0;  // of a layer
  std::vector<std::uint64_t> bits_;
  std::vector<std::uint32_t> before_;  // nodes before each word of bits_
  std::size_t count_ = 0;
};

/// Several regions' values at each of some nodes. Memory beyond the nodes: 4 bytes a node, 6 bytes a value, and 12 with
/// bends.
struct LabelValues {
  NodeSet nodes;
  std::vector<std::uint32_t> first;  ///< of each node its first value; one more at the end
  std::vector<LabelRank> ranks;      ///< ascending at each node
  std::vector<float> values;
  std::vector<std::array<float, 3>> bends{};  ///< second differences of each value along x, y, z; or none
  std::vector<double> added{};                ///< to all values of each rank, for its volume (label_volumes.h); or none
  std::vector<double> moved{};                ///< likewise, to most of them, for the volume of a mesh; or none

  /// Where the value of a rank at a node is, both of which it must hold.
  std::size_t entry_of(std::size_t position, LabelRank rank) const {
    std::size_t entry = first[nodes.number_of(position)];
    while (ranks[entry] != rank) ++entry;
    return entry;
  }
};

}  // namespace scantet
