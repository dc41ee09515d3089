// Private: the exact questions a Delaunay triangulation asks of points.
#pragma once

#include <array>
#include <cmath>

#include "scantet/base/geometry.h"
#include "scantet/delaunay/orthosphere.h"

namespace scantet::engine {

/// The exact sign, -1, 0 or 1, of dot(b - a, cross(c - a, d - a)): six times the signed volume of the tet.
int exact_orientation(const Point& a, const Point& b, const Point& c, const Point& d);

/// The same sign, worked out in doubles where they are sure of it.
inline int orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Vec ab = b - a;
  const Vec ac = c - a;
  const Vec ad = d - a;
  const double det = dot(ab, cross(ac, ad));
  const double largest = std::max({std::abs(ab.x), std::abs(ac.x), std::abs(ad.x)}) *
                         std::max({std::abs(ab.y), std::abs(ac.y), std::abs(ad.y)}) *
                         std::max({std::abs(ab.z), std::abs(ac.z), std::abs(ad.z)});
  // Six products of three differences and five sums: at most 6·8 roundings of 1.2e-16 of `largest`.
  constexpr double kError = 1e-14;
  constexpr double kUnderflow = 1e-280;
  if (largest > kUnderflow && std::abs(det) > kError * largest) return det > 0 ? 1 : -1;
  return exact_orientation(a, b, c, d);
}

/// Whether q is inside the circumsphere of a positively oriented tet. If all five points are on one sphere, the answer
/// is that for points lifted by infinitely small amounts, larger the later a point stands in lexicographic order. So
/// the triangulation is a function of the set of points (the simulation of simplicity, as CGAL's triangulations do it).
bool exact_in_sphere(const std::array<Point, 4>& tet, const Point& q);

/// Whether q has less than no power distance to the orthogonal sphere of a positively oriented tet of weighted points:
/// |q - c|² - q.weight < R², with its centre c and its R². Ties are broken as in exact_in_sphere, which it is without
/// weights.
bool exact_in_orthosphere(const std::array<WeightedPoint, 4>& tet, const WeightedPoint& q);

}  // namespace scantet::engine
