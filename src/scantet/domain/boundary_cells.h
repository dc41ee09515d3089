// Where a boundary may be, cell by cell: what lets distances to it be bounded instead of only sampled.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/trilinear.h"

namespace SCANTET_API scantet {

/// A parallelepiped in which a trilinear function is above zero inside of a surface, and nowhere else.
struct BoundaryCell {
  std::array<int, 3> id{};   ///< the domain's own name for it
  Point corner;              ///< world mm
  std::array<Vec, 3> edges;  ///< from there, world mm; linearly independent
  CellHeights heights{};     ///< at the corners; bit n of the position: at the far end of edges[n]
  bool shared = false;       ///< parts of where the function is above zero may be outside: see may_hold()
};

/// The cells of a domain's boundary. It consists of surfaces: surface n lies between the regions up to n and those
/// above n. Const methods may be called from many threads.
class BoundaryCells {
 public:
  virtual ~BoundaryCells() = default;

  /// How many surfaces there are.
  virtual std::size_t surfaces() const = 0;

  /// Groups that the cells of a surface are listed in, for threads to share. surface: less than surfaces(), here and
  /// below.
  virtual std::size_t groups(std::size_t surface) const = 0;
  /// Adds the cells of a group to `out`, always in the same order. group: less than groups(surface). All of a surface
  /// lies in the cells of its groups.
  virtual void cells_of(std::size_t surface, std::size_t group, std::vector<BoundaryCell>& out) const = 0;

  /// Adds cells to `out` such that all of the surface that is in the box, world mm, is in them.
  virtual void cells_in(std::size_t surface, const Box& box, std::vector<BoundaryCell>& out) const = 0;

  /// Whether some of the surface may be in that part of one of its cells that has local coordinates (shares of the
  /// edges, in [0, 1]) from `low` to `high`. Asked of shared cells only. Default: yes.
  virtual bool may_hold(std::size_t surface, const BoundaryCell& cell, const Vec& low, const Vec& high) const;
  /// Where something lies to a surface.
  enum class Side : std::uint8_t { unknown, inside, outside };
  /// The side of the surface that the convex hull of some points, at least one, world mm, lies on as a whole; unknown
  /// if it meets the surface, and also if that cannot be told at little cost.
  virtual Side side_of(std::size_t surface, std::span<const Point> hull) const = 0;
};

inline bool BoundaryCells::may_hold(std::size_t, const BoundaryCell&, const Vec&, const Vec&) const {
  return true;
}

/// The cells such that all of the surfaces that is in the box, world mm, is in them, surface by surface.
inline std::vector<BoundaryCell> cells_in_box(const BoundaryCells& cells, const Box& box) {
  std::vector<BoundaryCell> found;
  for (std::size_t surface = 0; surface < cells.surfaces(); ++surface) cells.cells_in(surface, box, found);
  return found;
}

}  // namespace scantet
