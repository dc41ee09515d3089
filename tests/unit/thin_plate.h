// A domain that is thin beside its box, for tests of what looks at places in the box.
#pragma once

#include "scantet/base/box_clip.h"
#include "scantet/domain/domain.h"

namespace scantet::test {

/// A plate 18 x 18 x 0.2 mm in a box of 20 mm: of 40 points along each axis of the box, none is in it.
class ThinPlate : public Domain {
 public:
  static constexpr double kVolume_mm3 = 18 * 18 * 0.2;

  explicit ThinPlate(bool knows_volume = true) : volume_mm3_(knows_volume ? kVolume_mm3 : 0) {}

  Box bounds() const override { return {{-10, -10, -10}, {10, 10, 10}}; }
  Region region_at(const Point& p) const override {
    for (int axis = 0; axis < 3; ++axis) {
      if (!(p[axis] > plate().min[axis] && p[axis] < plate().max[axis])) return kOutside;
    }
    return 1;
  }
  void crossings(const Segment& segment, Crossings& out) const override {
    out.clear();
    const auto inside = clipped(segment, plate());
    if (!inside || region_at(lerp(inside->source, inside->target, 0.5)) == kOutside) return;
    if (region_at(segment.source) == kOutside) out.push_back({inside->source, kOutside, 1});
    if (region_at(segment.target) == kOutside) out.push_back({inside->target, 1, kOutside});
  }
  std::vector<Component> components() const override { return {{1, {0, 0, 0.5}, plate(), volume_mm3_}}; }

 private:
  static Box plate() { return {{-9, -9, 0.4}, {9, 9, 0.6}}; }

  double volume_mm3_;
};

}  // namespace scantet::test
