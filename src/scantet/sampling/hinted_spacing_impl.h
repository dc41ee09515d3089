// Private: how far points are apart near hints of size.
#pragma once

#include <algorithm>
#include <cmath>
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
    std::vector<Point> places;
    places.reserve(hints_.size());
    for (const SizeHint& hint : hints_) places.push_back(hint.point);
    grid_ = PointGrid(places, widest_mm / share);
  }

  /// The spacing at p, mm, where it is spacing_mm away from hints.
  double at(const Point& p, double spacing_mm) const {
    double least = spacing_mm;
    grid_.any_near(p, spacing_mm / share_, [&](std::uint32_t i, const Point&, double squared) {
      least = std::min(least, share_ * (hints_[i].radius_mm + std::sqrt(squared)));
      return false;
    });
    return least;
  }

  const std::vector<SizeHint>& hints() const { return hints_; }

 private:
  std::vector<SizeHint> hints_;
  double share_ = 1;
  PointGrid grid_;
};

}  // namespace scantet
