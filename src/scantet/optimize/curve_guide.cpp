#include <algorithm>
#include <cmath>

#include "scantet/base/parallel.h"
#include "scantet/optimize/curve_guide_impl.h"

namespace scantet::optimize {

CurveGuide::CurveGuide(const Domain& domain) : within_mm_(0) {
  constexpr double kWithin = 1e-9;  // of the domain's diagonal
  constexpr int kSteps = 16;
  constexpr std::size_t kGrain = 64;
  std::vector<std::shared_ptr<const Curve>> curves = domain.curves();
  if (curves.empty()) return;
  within_mm_ = kWithin * domain.bounds().diagonal();
  curves_.resize(curves.size());
  parallel_for(curves.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double length_mm = curves[i]->length_mm();
      Box box;
      for (int k = 0; k <= kSteps; ++k) box.extend(curves[i]->at(length_mm * k / kSteps));
      const double beyond_mm = length_mm / (2 * kSteps) + within_mm_;  // no point is farther from one of these
      curves_[i] = {std::move(curves[i]), box.grown(beyond_mm)};
    }
  });
}

const Curve* CurveGuide::curve_at(const Point& p) const {
  const Curve* found = nullptr;
  for (const Entry& entry : curves_) {
    if (!entry.box.contains(p)) continue;
    const Curve::Nearest nearest = entry.curve->nearest(p);
    if (nearest.distance_mm > within_mm_) continue;
    const double from_end_mm = std::min(nearest.along_mm, entry.curve->length_mm() - nearest.along_mm);
    if (found != nullptr || (entry.curve->corners() && from_end_mm <= within_mm_)) return nullptr;
    found = entry.curve.get();
  }
  return found;
}

std::optional<Point> CurveGuide::step_along(const Curve& curve, const Point& from, double step_mm) {
  const double length_mm = curve.length_mm();
  double along_mm = curve.nearest(from).along_mm + step_mm;
  if (along_mm < 0 || along_mm > length_mm) {
    if (curve.corners()) return std::nullopt;
    along_mm -= std::copysign(length_mm, step_mm);
  }
  return curve.at(along_mm);
}

}  // namespace scantet::optimize
