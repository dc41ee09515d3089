// What the eight cells around a node join, and what changes there if the node changes sides.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scantet/topology/sided_nodes.h"

namespace scantet {

/// The 27 nodes around a node and itself, in the order of kNeighborhood, as they hang together in the eight cells.
struct BlockParts {
  std::uint32_t inside = 0;           ///< bit n is set if node n is inside
  std::array<std::uint8_t, 27> part;  ///< of each node: the smallest node of its part
  int eighths = 0;                    ///< shares of what is inside in an Euler number, as of add_cell_shares()
};

/// A node before it changes sides, and after.
struct SideChange {
  BlockParts before;
  BlockParts after;

  /// By how much the Euler number of all that is inside grows.
  int euler() const { return (after.eighths - before.eighths) / 8; }
};

/// Asks for changes of sides, and remembers answers that do not depend on heights.
class SideChanges {
 public:
  explicit SideChanges(const SidedNodes& nodes);

  /// Whether the node could change sides without anything changing but that: no part of either side in the block would
  /// be split, joined, made or lost, nor would the Euler number change. Whether, then, a neighbour along an edge is on
  /// its new side. Quick where no cell around leaves open what it joins; elsewhere false, and nothing is said.
  bool is_plainly_simple(std::int64_t n);

  /// What becomes of the block. n: not of the padding.
  SideChange look_at(std::int64_t n) const;

 private:
  enum class Known : std::uint8_t { nothing, simple, not_simple };
  struct Answer {
    std::uint32_t inside = 0;
    Known known = Known::nothing;
  };

  std::uint32_t inside_around(std::int64_t n) const;

  const SidedNodes& nodes_;
  std::array<std::int64_t, 27> steps_{};
  std::vector<Answer> answers_;  // by a hash of the signs
};

/// Whether the parts of the other 26 nodes are the same before and after, the node has neighbours of its part both
/// times, and the Euler number is the same.
bool is_simple(const SideChange& change);

}  // namespace scantet
