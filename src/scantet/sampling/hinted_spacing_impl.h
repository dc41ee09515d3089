// Private: how far points are apart near hints of size.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "scantet/base/point_grid_impl.h"
#include "scantet/domain/domain.h"

namespace scantet {

/// A spacing that is less near hints: there it is a share of the local feature size that they tell. Const methods may
/// be called from many threads.
class HintedSpacing {
 public:
  HintedSpacing() = default;

  /// share: of the local feature size, > 0. widest_mm: about the spacing that will be asked for away from hints.
  HintedSpacing(std::vector<SizeHint> hints, double share, double widest_mm) : hints_(std::move(hints)), share_(share) {
    constexpr double kRoom = 2;  // the first look, over what hints would be apart that fill their box evenly
    Box box;
    std::vector<Point> places;
    places.reserve(hints_.size());
    for (const SizeHint& hint : hints_) {
      places.push_back(hint.point);
      box.extend(hint.point);
      least_radius_mm_ = std::min(least_radius_mm_, hint.radius_mm);
    }
    first_mm_ = widest_mm / share;
    if (!box.empty()) {
      const Vec e = box.extent();
      const double apart_mm = std::cbrt(e.x * e.y * e.z / static_cast<double>(hints_.size()));
      if (apart_mm > 0) first_mm_ = std::min(first_mm_, kRoom * apart_mm);
    }
    grid_ = PointGrid(places, first_mm_);
  }

  /// The spacing at p, mm, where it is spacing_mm away from hints. Looks farther and farther, until no hint that is
  /// farther still can ask for less: of many that are close together it sees a few.
  double at(const Point& p, double spacing_mm) const {
    constexpr double kBeyondRounding = 1 + 1e-12;
    double least = spacing_mm;
    const auto farthest_mm = [&] {
      return std::min(spacing_mm / share_, kBeyondRounding * (least / share_ - least_radius_mm_));
    };
    if (hints_.empty()) return least;
    for (double radius_mm = std::min(first_mm_, farthest_mm());; radius_mm = std::min(2 * radius_mm, farthest_mm())) {
      grid_.any_near(p, radius_mm, [&](std::uint32_t i, const Point&, double squared) {
        least = std::min(least, share_ * (hints_[i].radius_mm + std::sqrt(squared)));
        return false;
      });
      if (radius_mm >= farthest_mm()) return least;
    }
  }

  const std::vector<SizeHint>& hints() const { return hints_; }

 private:
  std::vector<SizeHint> hints_;
  double share_ = 1;
  double least_radius_mm_ = std::numeric_limits<double>::infinity();  // of the hints
  double first_mm_ = 0;                                               // how far is looked at first
  PointGrid grid_;
};

}  // namespace scantet
