// A point of the curve is asked for anew each time: nothing is kept but the polyline.
#include "scantet/cuts/rim_curve.h"

#include <algorithm>
#include <utility>

#include "scantet/domain/nearest_crossing.h"

namespace scantet {

std::optional<Point> meeting_across(const Domain& domain, const CutPlane& plane, const RimSides& sides, const Point& p,
                                    const Vec& direction, double reach_mm) {
  const Vec across = cross(plane.normal, direction);  // to the left
  const double norm = length(across);
  if (!(norm > 0)) return std::nullopt;
  const Vec reach = (reach_mm / norm) * across;
  Crossings crossings;
  domain.crossings({plane.nearest(p - reach), plane.nearest(p + reach)}, crossings);
  const Crossing* const nearest =
      nearest_crossing(crossings, p, [&](const Crossing& c) { return c.from == sides.right && c.to == sides.left; });
  return nearest == nullptr ? std::nullopt : std::optional(plane.nearest(nearest->point));
}

RimCurve::RimCurve(const Domain& domain, const CutPlane& plane, const RimSides& sides, PolylineCurve course,
                   double beside_mm)
    : CourseCurve(std::move(course)), domain_(domain), plane_(plane), sides_(sides), beside_mm_(beside_mm) {
  along_mm_.push_back(0);
  const std::vector<Point>& points = this->course().points();
  for (std::size_t i = 1; i < points.size(); ++i) {
    along_mm_.push_back(along_mm_.back() + distance(points[i - 1], points[i]));
  }
}

Vec RimCurve::direction_at(double along_mm) const {
  const double step_mm = std::min(beside_mm_, 0.1 * length_mm());
  return course().at(along_mm + step_mm) - course().at(along_mm - step_mm);
}

Point RimCurve::at(double along_mm) const {
  const Point guess = course().at(along_mm);
  if (course().corners() && (along_mm <= 0 || along_mm >= length_mm())) return guess;  // a corner
  if (const auto place = meeting_across(domain_, plane_, sides_, guess, direction_at(along_mm), beside_mm_))
    return *place;
  const auto next = std::upper_bound(along_mm_.begin() + 1, along_mm_.end() - 1, along_mm);
  const auto i = static_cast<std::size_t>(next - along_mm_.begin());
  return course().points()[along_mm - along_mm_[i - 1] <= along_mm_[i] - along_mm ? i - 1 : i];
}

Curve::Nearest RimCurve::nearest(const Point& p) const {
  Nearest nearest = course().nearest(p);
  if (nearest.distance_mm > beside_mm_) return nearest;
  // From p itself: of a point on the curve the distance is none then, whatever its place beside the polyline.
  const auto place =
      meeting_across(domain_, plane_, sides_, plane_.nearest(p), direction_at(nearest.along_mm), beside_mm_);
  if (!place || distance(*place, p) >= nearest.distance_mm) return nearest;
  return {*place, nearest.along_mm, distance(*place, p)};
}

}  // namespace scantet
