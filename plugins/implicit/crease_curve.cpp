#include "crease_curve.h"

#include <cmath>

namespace implicit {

using scantet::Point;
using scantet::Vec;

std::optional<Point> settled(const SignTree& tree, const std::vector<std::size_t>& parts, const Point& start,
                             double reach_mm) {
  constexpr int kMostSteps = 30;
  constexpr double kRounding = 1e-14;
  Point p = start;
  for (int step = 0; step < kMostSteps; ++step) {
    std::array<SurfaceValue, 3> at{};
    for (std::size_t n = 0; n < parts.size(); ++n) at[n] = tree.at(parts[n], p);
    const Vec& a = at[0].slope;
    const Vec& b = at[1].slope;
    const Vec along = cross(a, b);
    // The third equation is that the step has nothing along the curve, or the third part.
    const Vec c = parts.size() == 3 ? at[2].slope : along;
    const double determinant = dot(along, c);
    if (!(std::abs(determinant) > 1e-12 * length(a) * length(b) * length(c))) return std::nullopt;
    const Vec move = (-1 / determinant) * (at[0].value * cross(b, c) + at[1].value * cross(c, a) +
                                           (parts.size() == 3 ? at[2].value : 0) * along);
    p = p + move;
    if (!(distance(p, start) <= reach_mm)) return std::nullopt;
    if (length(move) <= kRounding * (reach_mm + length(p))) return p;
  }
  return p;
}

scantet::Point CreaseCurve::at(double along_mm) const {
  const Point guess = course_.at(along_mm);
  return is_end(along_mm) ? guess : settled(*tree_, parts_, guess, reach_mm_).value_or(guess);
}

scantet::Curve::Nearest CreaseCurve::nearest(const Point& p) const {
  const Nearest nearest = course_.nearest(p);
  if (nearest.distance_mm > reach_mm_ || is_end(nearest.along_mm)) return nearest;
  // From p itself: of a point on the curve the distance is none then.
  const auto place = settled(*tree_, parts_, p, reach_mm_);
  if (!place || distance(*place, p) >= nearest.distance_mm) return nearest;
  return {*place, nearest.along_mm, distance(*place, p)};
}

}  // namespace implicit
