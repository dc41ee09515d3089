// The points are sorted first, so that every cell that shares them gets the same centre. Cramer's rule relative to the
// first point loses all digits when the tet is nearly flat: then the same formula is evaluated in rational numbers.
#include "scantet/delaunay/orthosphere.h"

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scantet::engine {
namespace {

using Rational = CGAL::Exact_rational;
using RationalVec = std::array<Rational, 3>;

RationalVec exact_cross(const RationalVec& a, const RationalVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Rational exact_dot(const RationalVec& a, const RationalVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Exact, but for the rounding of the result. Pre: the points are not on one plane.
Point exact_orthocentre(const std::array<WeightedPoint, 4>& t) {
  const auto at = [&](std::size_t i) {
    return RationalVec{Rational(t[i].point.x), Rational(t[i].point.y), Rational(t[i].point.z)};
  };
  const RationalVec origin = at(0);
  std::array<RationalVec, 3> edge;
  std::array<Rational, 3> power;
  for (std::size_t i = 0; i < 3; ++i) {
    const RationalVec end = at(i + 1);
    for (std::size_t k = 0; k < 3; ++k) edge[i][k] = end[k] - origin[k];
    power[i] = exact_dot(edge[i], edge[i]) + Rational(t[0].weight) - Rational(t[i + 1].weight);
  }
  const std::array<RationalVec, 3> across{exact_cross(edge[1], edge[2]), exact_cross(edge[2], edge[0]),
                                          exact_cross(edge[0], edge[1])};
  const Rational twice = 2 * exact_dot(edge[0], across[0]);
  std::array<double, 3> center{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational sum = power[0] * across[0][k] + power[1] * across[1][k] + power[2] * across[2][k];
    center[k] = CGAL::to_double(Rational(origin[k] + sum / twice));
  }
  return {center[0], center[1], center[2]};
}

}  // namespace

void sort_points(std::array<WeightedPoint, 4>& t) {
  std::sort(t.begin(), t.end(),
            [](const WeightedPoint& a, const WeightedPoint& b) { return lexicographically_less(a.point, b.point); });
}

Point quick_orthocentre(const std::array<WeightedPoint, 4>& t, double& determinant) {
  const Vec a = t[1].point - t[0].point;
  const Vec b = t[2].point - t[0].point;
  const Vec c = t[3].point - t[0].point;
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
  const double weight = t[0].weight;
  return t[0].point + (0.5 / det) * ((aa + weight - t[1].weight) * bc + (bb + weight - t[2].weight) * cross(c, a) +
                                     (cc + weight - t[3].weight) * cross(a, b));
}

Point orthocentre(std::array<WeightedPoint, 4> tet) {
  sort_points(tet);
  double determinant = 0;
  const Point quick = quick_orthocentre(tet, determinant);
  return std::isnan(quick.x) ? exact_orthocentre(tet) : quick;
}

Point orthocentre(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const Vec a = q.point - p.point;
  const Vec b = r.point - p.point;
  const Vec n = cross(a, b);
  return p.point + (0.5 / dot(n, n)) * ((dot(a, a) + p.weight - q.weight) * cross(b, n) +
                                        (dot(b, b) + p.weight - r.weight) * cross(n, a));
}

double orthoradius_edge(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c) {
  const double shortest = std::min(
      {squared_distance(a.point, b.point), squared_distance(b.point, c.point), squared_distance(c.point, a.point)});
  const double squared = squared_distance(orthocentre(a, b, c), a.point) - a.weight;
  if (std::isnan(squared)) return std::numeric_limits<double>::infinity();
  return std::sqrt(std::max(squared, 0.0) / shortest);
}

}  // namespace scantet::engine
