// The measures of a degenerate facet are infinite or NaN. Shares are computed so that these become a share of 0, that
// is, the facet has nothing of what is asked for.
#include <cmath>
#include <limits>

#include "scantet/domain/nearest_crossing.h"
#include "scantet/optimize/facet_judge_impl.h"

namespace scantet::optimize {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1 + 1e-9;

double share(double asked, double has) {
  const double share = asked * asked * kRounding * kRounding / has;
  return share >= 0 ? share : 0;
}

/// A facet's plane and circumcircle.
struct FacetForm {
  explicit FacetForm(const Corners& facet) {
    const Vec a = facet[1] - facet[0];
    const Vec b = facet[2] - facet[0];
    normal = cross(a, b);
    const double aa = dot(a, a);
    const double bb = dot(b, b);
    squared_normal = squared_length(normal);
    const Vec offset = (0.5 / squared_normal) * (bb * cross(normal, a) + aa * cross(b, normal));
    center = facet[0] + offset;
    squared_radius = squared_length(offset);
    squared_edge = std::min({aa, bb, squared_distance(facet[1], facet[2])});
  }
  /// Of a facet of which R2 asks this radius.
  double share_of_shape(const RuleBounds& bounds, double most_radius) const {
    return share(bounds.facet_radius_edge * bounds.slack(std::sqrt(squared_radius), most_radius),
                 squared_radius / squared_edge);
  }

  Vec normal;
  double squared_normal;
  Point center;
  double squared_radius;
  double squared_edge;
};

}  // namespace

double FacetJudge::share_of_shape(const Corners& facet) const {
  const FacetForm form(facet);
  if (!is_finite(form.center)) return 0;
  return form.share_of_shape(target_.bounds, target_.bounds.alpha * target_.size->size_at(form.center));
}

FacetShares FacetJudge::shares(const Corners& facet, Crossings& crossings) const {
  const FacetForm form(facet);
  const Point& center = form.center;
  if (!is_finite(center)) return {0, 0, 0};
  const RuleBounds& bounds = target_.bounds;
  const double reach_mm = bounds.alpha * target_.size->size_at(center);
  FacetShares shares{form.share_of_shape(bounds, reach_mm), 0, kInfinity};
  const Vec reach = (reach_mm / std::sqrt(form.squared_normal)) * form.normal;
  domain_->crossings({center - reach, center + reach}, crossings);
  const Crossing* const nearest = nearest_crossing(crossings, center);
  if (nearest == nullptr) return shares;
  const double squared_off = squared_distance(nearest->point, center);
  shares.size = share(bounds.alpha * target_.size->size_at(nearest->point), form.squared_radius + squared_off);
  if (bounds.facet_distance_mm) shares.distance = share(*bounds.facet_distance_mm, squared_off);
  return shares;
}

}  // namespace scantet::optimize
