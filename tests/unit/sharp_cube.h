// A cube whose edges are to be sharp.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "scantet/domain/domain.h"

namespace scantet::test {

/// A cube around the origin, whose twelve edges are to be sharp.
class SharpCube final : public Domain {
 public:
  explicit SharpCube(double side_mm) : half_(side_mm / 2) {
    const auto sign = [&](std::size_t i, int bit) { return (i >> bit & 1) != 0 ? half_ : -half_; };
    for (std::size_t i = 0; i < 8; ++i) corners_.push_back({{sign(i, 0), sign(i, 1), sign(i, 2)}, {0, 1}, ""});
    for (std::size_t i = 0; i < 8; ++i) {
      for (const std::size_t bit : {1, 2, 4}) {
        if ((i & bit) != 0) continue;
        curves_.push_back(
            std::make_shared<PolylineCurve>(std::vector<Point>{corners_[i].point, corners_[i | bit].point},
                                            std::vector<Region>{0, 1}, std::array<std::size_t, 2>{i, i | bit}));
      }
    }
  }
  Box bounds() const override {
    const double r = 1.1 * half_;
    return {{-r, -r, -r}, {r, r, r}};
  }
  Region region_at(const Point& p) const override {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < half_ ? 1 : kOutside;
  }
  void crossings(const Segment& segment, Crossings& out) const override {
    out.clear();
    double enter = 0, leave = 1;
    const std::array<double, 3> from{segment.source.x, segment.source.y, segment.source.z};
    const std::array<double, 3> to{segment.target.x, segment.target.y, segment.target.z};
    for (std::size_t k = 0; k < 3; ++k) {
      const double way = to[k] - from[k];
      if (way == 0) {
        if (std::abs(from[k]) >= half_) return;
        continue;
      }
      const auto [first, last] = std::minmax({(-half_ - from[k]) / way, (half_ - from[k]) / way});
      enter = std::max(enter, first);
      leave = std::min(leave, last);
    }
    const bool starts_in = region_at(segment.source) != kOutside;
    const bool ends_in = region_at(segment.target) != kOutside;
    if (enter >= leave && !starts_in && !ends_in) return;
    const auto at = [&](double t) { return lerp(segment.source, segment.target, t); };
    if (!starts_in) out.push_back({at(enter), kOutside, 1});
    if (!ends_in) out.push_back({at(leave), 1, kOutside});
  }
  std::vector<std::shared_ptr<const Curve>> curves() const override { return curves_; }
  std::vector<Corner> corners() const override { return corners_; }

 private:
  double half_;
  std::vector<std::shared_ptr<const Curve>> curves_;
  std::vector<Corner> corners_;
};

}  // namespace scantet::test
