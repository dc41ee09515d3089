// Cells where a part that is kept and one that is left out or filled meet.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/progress.h"
#include "scantet/field/cell_walk.h"
#include "scantet/field/height_grid.h"

namespace SCANTET_API scantet {

/// A cell whose inside nodes are of both kinds, kept and left out, or whose outside nodes are: kept and filled. No edge
/// joins one kind to the other.
struct SharedCell {
  CellIndex cell{};
  CellHeights heights{};     ///< as the scan was read
  std::uint8_t dropped = 0;  ///< bit c: corner c is inside as it was read, and left out
  std::uint8_t filled = 0;   ///< bit c: corner c is outside as it was read, and filled

  /// Whether a point (local coordinates, each in [0, 1]) is inside what is made of the scan. above: whether it is above
  /// the level as the scan was read.
  bool inside(const Vec& u, bool above) const {
    if (above) return (dropped >> corner_reached(u, 1) & 1) == 0;
    return filled != 0 && (filled >> corner_reached(u, -1) & 1) != 0;
  }
  /// The same, `above` by the heights.
  bool inside(const Vec& u) const { return inside(u, trilinear(heights, u) > 0); }

  /// Whether the boundary of what is made of the scan may be in the box from `low` to `high` (local coordinates), where
  /// heights of both signs are; false is certain.
  bool may_hold_boundary(const Vec& low, const Vec& high) const {
    const auto may_reach = [&](double way, int corners) { return (corners_reached(low, high, way) & corners) != 0; };
    return (may_reach(1, ~dropped) && may_reach(-1, ~filled)) || (may_reach(1, dropped) && may_reach(-1, filled));
  }

 private:
  /// The corners that corner_reached() may give between two points, as bits. What it compares is linear along each
  /// axis, so that the corners of the box decide.
  int corners_reached(const Vec& low, const Vec& high, double way) const {
    const auto along_x = [&](int corner, double x) { return mix(heights[corner], heights[corner + 1], x); };
    const auto along_y = [&](int corner, double x, double y) {
      return mix(along_x(corner, x), along_x(corner + 2, x), y);
    };
    const auto may_be = [&](bool up, std::initializer_list<double> rises) {
      return std::any_of(rises.begin(), rises.end(), [&](double rise) { return (way * rise > 0) == up; });
    };
    const auto rise_z = [&](double x, double y) { return along_y(4, x, y) - along_y(0, x, y); };
    int reached = 0;
    for (const int z : {0, 4}) {
      if (!may_be(z != 0,
                  {rise_z(low.x, low.y), rise_z(high.x, low.y), rise_z(low.x, high.y), rise_z(high.x, high.y)})) {
        continue;
      }
      const auto rise_y = [&](double x) { return along_x(z + 2, x) - along_x(z, x); };
      for (const int y : {0, 2}) {
        if (!may_be(y != 0, {rise_y(low.x), rise_y(high.x)})) continue;
        const int corner = z + y;
        reached |= 1 << (way * heights[corner + 1] > way * heights[corner] ? corner + 1 : corner);
      }
    }
    return reached;
  }
  /// The corner that one reaches from a point along z, y and x, going up (way 1) or down (way -1).
  int corner_reached(const Vec& u, double way) const {
    const auto along_x = [&](int corner) { return mix(heights[corner], heights[corner + 1], u.x); };
    const auto along_y = [&](int corner) { return mix(along_x(corner), along_x(corner + 2), u.y); };
    int corner = way * along_y(4) > way * along_y(0) ? 4 : 0;
    if (way * along_x(corner + 2) > way * along_x(corner)) corner += 2;
    if (way * heights[corner + 1] > way * heights[corner]) corner += 1;
    return corner;
  }
};

/// The shared cells of one level, by cell. Immutable.
class SharedCells {
 public:
  /// cells: each once, in the order of k, then j, then i.
  explicit SharedCells(std::vector<SharedCell> cells) : cells_(std::move(cells)) {}

  /// The shared cell; null if the cell is not shared. Valid as long as this lives.
  const SharedCell* find(const CellIndex& cell) const;
  /// How many there are.
  std::size_t count() const { return cells_.size(); }

 private:
  std::vector<SharedCell> cells_;
};

/// What a field (trilinear_domain.h) knows of a cell as shared: the SharedCell, or null. A field without such cells
/// needs no shared(): the answer is null when the program is compiled.
template <class Field>
const SharedCell* shared_cell(const Field& field, const CellIndex& cell) {
  if constexpr (requires { field.shared(cell); }) {
    return field.shared(cell);
  } else {
    return nullptr;
  }
}

/// Finds the shared cells in one sweep, on several threads. as_read, kept: the heights of a scan, of one size, before
/// and after nodes of whole components were turned outside, and those of whole cavities inside. Null if no cell is
/// shared. Some may be missing once progress.cancelled() became true.
std::shared_ptr<const SharedCells> find_shared_cells(const HeightGrid& as_read, const HeightGrid& kept,
                                                     const Progress& progress);

}  // namespace scantet
