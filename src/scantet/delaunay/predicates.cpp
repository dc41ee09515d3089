// CGAL's kernel decides; it tries its own filters before exact arithmetic.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cassert>

#include "scantet/delaunay/predicates_impl.h"

namespace scantet::engine {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 to_cgal(const Point& p) {
  return {p.x, p.y, p.z};
}

Kernel::Weighted_point_3 to_cgal(const WeightedPoint& p) {
  return {to_cgal(p.point), p.weight};
}

/// exact_in_sphere() of five points on one sphere.
bool in_sphere_once_lifted(const std::array<Point, 4>& tet, const Point& q) {
  // q is inside if it lies below the hyperplane through the four lifted points. Lifting q brings it out; lifting point
  // k raises the hyperplane over q by the barycentric coordinate of q at k, whose sign is an orientation. The largest
  // lift that has any effect decides, and the lift of q has one.
  std::array<int, 5> order{0, 1, 2, 3, 4};
  const auto at = [&](int i) -> const Point& { return i == 4 ? q : tet[static_cast<std::size_t>(i)]; };
  std::sort(order.begin(), order.end(), [&](int i, int j) { return lexicographically_less(at(j), at(i)); });
  for (const int k : order) {
    if (k == 4) return false;
    std::array<Point, 4> replaced = tet;
    replaced[static_cast<std::size_t>(k)] = q;
    const int sign = orientation(replaced[0], replaced[1], replaced[2], replaced[3]);
    if (sign != 0) return sign > 0;
  }
  return false;
}

}  // namespace

int exact_orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  return static_cast<int>(CGAL::orientation(to_cgal(a), to_cgal(b), to_cgal(c), to_cgal(d)));
}

bool exact_in_sphere(const std::array<Point, 4>& tet, const Point& q) {
  assert(orientation(tet[0], tet[1], tet[2], tet[3]) > 0);
  const auto side =
      CGAL::side_of_oriented_sphere(to_cgal(tet[0]), to_cgal(tet[1]), to_cgal(tet[2]), to_cgal(tet[3]), to_cgal(q));
  if (side != CGAL::ON_ORIENTED_BOUNDARY) return side == CGAL::ON_POSITIVE_SIDE;
  return in_sphere_once_lifted(tet, q);
}

bool exact_in_orthosphere(const std::array<WeightedPoint, 4>& tet, const WeightedPoint& q) {
  const std::array<Point, 4> points{tet[0].point, tet[1].point, tet[2].point, tet[3].point};
  assert(orientation(points[0], points[1], points[2], points[3]) > 0);
  const auto side = CGAL::power_side_of_oriented_power_sphere(to_cgal(tet[0]), to_cgal(tet[1]), to_cgal(tet[2]),
                                                              to_cgal(tet[3]), to_cgal(q));
  if (side != CGAL::ON_ORIENTED_BOUNDARY) return side == CGAL::ON_POSITIVE_SIDE;
  return in_sphere_once_lifted(points, q.point);  // weights lift all points the same way
}

}  // namespace scantet::engine
