// The nearest point is searched piece by piece, but for runs of pieces whose box is farther than the best so far.
#include "scantet/domain/curve.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scantet/base/box_distance.h"
#include "scantet/base/error.h"

namespace scantet {
namespace {

constexpr std::size_t kPerBox = 16;

[[noreturn]] void refuse(const std::string& what) {
  throw Error(Fault::usage, "usage.curve", what, "give a polyline of distinct, finite points");
}

}  // namespace

PolylineCurve::PolylineCurve(std::vector<Point> points, std::vector<Region> regions,
                             std::optional<std::array<std::size_t, 2>> corners, std::string name)
    : points_(std::move(points)), regions_(std::move(regions)), corners_(corners), name_(std::move(name)) {
  if (points_.size() < 2) refuse("a curve of " + std::to_string(points_.size()) + " points");
  along_mm_.assign(1, 0);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!is_finite(points_[i])) refuse("point " + std::to_string(i) + " of a curve is not finite");
    if (i == 0) continue;
    const double step = distance(points_[i - 1], points_[i]);
    if (!(step > 0)) refuse("points " + std::to_string(i - 1) + " and " + std::to_string(i) + " of a curve are equal");
    along_mm_.push_back(along_mm_.back() + step);
  }
  if (!corners_ && points_.front() != points_.back()) refuse("a curve without corners that is not closed");
  for (std::size_t first = 0; first + 1 < points_.size(); first += kPerBox) {
    boxes_.emplace_back();
    const std::size_t last = std::min(first + kPerBox, points_.size() - 1);
    for (std::size_t i = first; i <= last; ++i) boxes_.back().extend(points_[i]);
  }
}

Point PolylineCurve::at(double along_mm) const {
  if (!(along_mm > 0)) return points_.front();
  if (along_mm >= length_mm()) return points_.back();
  const auto next = std::upper_bound(along_mm_.begin(), along_mm_.end(), along_mm) - along_mm_.begin();
  const auto i = static_cast<std::size_t>(next);
  return lerp(points_[i - 1], points_[i], (along_mm - along_mm_[i - 1]) / (along_mm_[i] - along_mm_[i - 1]));
}

Curve::Nearest PolylineCurve::nearest(const Point& p) const {
  Nearest best{points_.front(), 0, 0};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t box = 0; box < boxes_.size(); ++box) {
    if (squared_distance(boxes_[box], p) >= least) continue;
    const std::size_t last = std::min((box + 1) * kPerBox, points_.size() - 1);
    for (std::size_t i = box * kPerBox; i < last; ++i) {
      const Vec along = points_[i + 1] - points_[i];
      const double t = std::clamp(dot(p - points_[i], along) / dot(along, along), 0.0, 1.0);
      const Point q = lerp(points_[i], points_[i + 1], t);
      const double squared = squared_distance(p, q);
      if (squared >= least) continue;
      least = squared;
      best = {q, along_mm_[i] + t * (along_mm_[i + 1] - along_mm_[i]), 0};
    }
  }
  best.distance_mm = std::sqrt(least);
  return best;
}

}  // namespace scantet
