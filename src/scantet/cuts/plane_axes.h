// Two axes in a plane.
#pragma once

#include "scantet/base/axis_across.h"
#include "scantet/cuts/cut_plane.h"

namespace scantet {

/// Coordinates (u, v) in a plane, mm, right-handed seen from beyond it. The plane outlives this.
class PlaneAxes {
 public:
  /// The origin is the point of the plane nearest to `near`.
  PlaneAxes(const CutPlane& plane, const Point& near) : plane_(plane), origin_(plane.nearest(near)) {
    u_ = cross(axis_across(plane.normal), plane.normal);
    u_ = (1 / length(u_)) * u_;
    v_ = cross(plane.normal, u_);
  }

  const CutPlane& plane() const { return plane_; }
  const Vec& u_axis() const { return u_; }
  const Vec& v_axis() const { return v_; }
  Point at(double u, double v) const { return plane_.nearest(origin_ + u * u_ + v * v_); }
  double u_of(const Point& p) const { return dot(u_, p - origin_); }
  double v_of(const Point& p) const { return dot(v_, p - origin_); }

 private:
  const CutPlane& plane_;
  Point origin_;
  Vec u_;
  Vec v_;
};

}  // namespace scantet
