// Circumcentres that depend on the points only, not on their order, and that stay right for flat tets.
#pragma once

#include <array>
#include <limits>
#include <utility>

#include "scantet/base/geometry.h"

namespace scantet::engine {

/// Circumcentre of four points in general position, mm. Any order of the points gives the same bits. Computed in double
/// precision; exactly (then rounded) where the points are so close to a plane that doubles would not do.
Point circumcentre(std::array<Point, 4> tet);

/// Lexicographic order.
inline void sort_points(std::array<Point, 4>& t) {
  const auto sort2 = [&](std::size_t i, std::size_t j) {
    if (lexicographically_less(t[j], t[i])) std::swap(t[i], t[j]);
  };
  sort2(0, 1), sort2(2, 3), sort2(0, 2), sort2(1, 3), sort2(1, 2);
}

/// Circumradius over shortest edge of a triangle; infinity if it is degenerate.
double radius_edge(const Point& a, const Point& b, const Point& c);

/// Circumcentre of a triangle, mm.
Point circumcentre(const Point& a, const Point& b, const Point& c);

/// Squared length of the shortest of the six edges, mm².
double squared_shortest_edge(const std::array<Point, 4>& tet);

}  // namespace scantet::engine
