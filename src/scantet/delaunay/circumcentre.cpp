// The points are sorted first, so that every cell that shares them gets the same circumcentre. Cramer's rule relative
// to the first point loses all digits when the tet is nearly flat: then the same formula is evaluated in rational
// numbers.
#include "scantet/delaunay/circumcentre.h"

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>

namespace scantet::engine {
namespace {

/// Exact, but for the rounding of the result.
Point exact_circumcentre(const std::array<Point, 4>& t) {
  using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;
  const auto at = [&](std::size_t i) { return Exact::Point_3(t[i].x, t[i].y, t[i].z); };
  const Exact::Point_3 c = CGAL::circumcenter(at(0), at(1), at(2), at(3));
  return {CGAL::to_double(c.x()), CGAL::to_double(c.y()), CGAL::to_double(c.z())};
}

}  // namespace

Point circumcentre(std::array<Point, 4> t) {
  sort_points(t);
  double determinant = 0;
  const Point quick = quick_circumcentre(t, determinant);
  return std::isnan(quick.x) ? exact_circumcentre(t) : quick;
}

Point circumcentre(const Point& p, const Point& q, const Point& r) {
  const Vec a = q - p;
  const Vec b = r - p;
  const Vec n = cross(a, b);
  return p + (0.5 / dot(n, n)) * (dot(a, a) * cross(b, n) + dot(b, b) * cross(n, a));
}

double radius_edge(const Point& a, const Point& b, const Point& c) {
  const double ab = squared_distance(a, b);
  const double bc = squared_distance(b, c);
  const double ca = squared_distance(c, a);
  const double twice_area = length(cross(b - a, c - a));
  const double shortest = std::sqrt(std::min({ab, bc, ca}));
  return std::sqrt(ab) * std::sqrt(bc) * std::sqrt(ca) / (2 * twice_area * shortest);
}

double squared_shortest_edge(const std::array<Point, 4>& t) {
  return std::min({squared_distance(t[0], t[1]), squared_distance(t[0], t[2]), squared_distance(t[0], t[3]),
                   squared_distance(t[1], t[2]), squared_distance(t[1], t[3]), squared_distance(t[2], t[3])});
}

}  // namespace scantet::engine
