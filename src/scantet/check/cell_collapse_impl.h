// Private to check/: cells of a grid, and which of them are needed for its topology.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scantet/base/geometry.h"

namespace scantet::auditing {

/// A node, an edge, a face or a cube of a grid, by its centre in half steps: along an axis on which it has a width that
/// is odd, on others twice the index of its nodes.
struct GridCell {
  std::array<std::int32_t, 3> center{};  ///< each at least -2

  bool is_wide(std::size_t axis) const { return (center[axis] & 1) != 0; }
  int dimension() const { return is_wide(0) + is_wide(1) + is_wide(2); }
  /// Along which an edge is wide.
  std::size_t axis() const { return is_wide(0) ? 0 : is_wide(1) ? 1 : 2; }
  /// In steps.
  Vec middle() const { return {0.5 * center[0], 0.5 * center[1], 0.5 * center[2]}; }
  /// The index of its first node along an axis.
  std::int32_t first(std::size_t axis) const { return (center[axis] - is_wide(axis)) / 2; }
  /// The index of its last node.
  std::int32_t last(std::size_t axis) const { return first(axis) + is_wide(axis); }
  friend auto operator<=>(const GridCell&, const GridCell&) = default;
};

/// Cells of a complex that have the others around them with them: with a cell all those that it is part of. Takes away
/// pairs of a cell and the only one of a dimension more that it is part of, for as long as there are such pairs. By
/// that the complex shrinks and keeps its homotopy type, so if nothing is left it has that of its other cells alone.
/// cells: each once. Return: what is left, in groups of cells that are part of each other; ascending, the groups by
/// their first cells.
std::vector<std::vector<GridCell>> collapsed(std::vector<GridCell> cells);

}  // namespace scantet::auditing
