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

inline constexpr double kFlat = 1e-9;  ///< relative determinant below which fewer than seven digits would be left

/// circumcentre() in double precision: NaN where that would not do, and last bits that depend on the order of the
/// points (none for sort_points). determinant: six times the volume, less some digits where the tet is flat.
inline Point quick_circumcentre(const std::array<Point, 4>& t, double& determinant) {
  const Vec a = t[1] - t[0];
  const Vec b = t[2] - t[0];
  const Vec c = t[3] - t[0];
  const Vec bc = cross(b, c);
  const double det = dot(a, bc);
  const double aa = dot(a, a);
  const double bb = dot(b, b);
  const double cc = dot(c, c);
  determinant = std::abs(det);
  if (!(det * det > kFlat * kFlat * aa * bb * cc)) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    return {kNan, kNan, kNan};
  }
  return t[0] + (0.5 / det) * (aa * bc + bb * cross(c, a) + cc * cross(a, b));
}

/// Circumradius over shortest edge of a triangle; infinity if it is degenerate.
double radius_edge(const Point& a, const Point& b, const Point& c);

/// Circumcentre of a triangle, mm.
Point circumcentre(const Point& a, const Point& b, const Point& c);

/// Squared length of the shortest of the six edges, mm².
double squared_shortest_edge(const std::array<Point, 4>& tet);

}  // namespace scantet::engine
