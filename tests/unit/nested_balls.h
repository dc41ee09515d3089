// A domain of two regions for tests that know no images.
#pragma once

#include <algorithm>
#include <memory>

#include "scantet/domain/analytic.h"

namespace scantet::test {

/// Around the origin a ball of region 2 within one of region 1.
class NestedBalls : public Domain {
 public:
  NestedBalls(double inner_mm, double outer_mm)
      : inner_mm_(inner_mm),
        outer_mm_(outer_mm),
        inner_(make_sphere({}, inner_mm)),
        outer_(make_sphere({}, outer_mm)) {}

  Box bounds() const override { return outer_->bounds(); }
  Region region_at(const Point& p) const override { return outer_->region_at(p) + inner_->region_at(p); }
  void crossings(const Segment& segment, Crossings& out) const override {
    outer_->crossings(segment, out);
    Crossings inner;
    inner_->crossings(segment, inner);
    out.insert(out.end(), inner.begin(), inner.end());
    std::sort(out.begin(), out.end(), [&](const Crossing& a, const Crossing& b) {
      return distance(a.point, segment.source) < distance(b.point, segment.source);
    });
    Region region = region_at(segment.source);
    for (Crossing& crossing : out) {
      const Region step = crossing.to - crossing.from;
      crossing = {crossing.point, region, region + step};
      region += step;
    }
  }
  std::vector<Component> components() const override {
    Component shell{1, {0, 0, 0.5 * (inner_mm_ + outer_mm_)}, outer_->bounds()};
    return {shell, {2, {}, inner_->bounds()}};
  }
  Patch patch_at(const Point& p) const override {
    return length(p) > 0.5 * (inner_mm_ + outer_mm_) ? Patch{{0, 1}, {}} : Patch{{1, 2}, {}};
  }

 private:
  double inner_mm_;
  double outer_mm_;
  std::unique_ptr<Domain> inner_;
  std::unique_ptr<Domain> outer_;
};

}  // namespace scantet::test
