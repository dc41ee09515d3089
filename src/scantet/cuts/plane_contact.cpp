// What only crosses the plane is in it at a place or two: two are asked for, and none on lines that a face may be on.
#include "scantet/cuts/plane_contact.h"

#include <algorithm>
#include <cmath>

#include "scantet/cuts/plane_axes.h"

namespace scantet {
namespace {

constexpr int kPlaces = 7;       // looked at of each curve
constexpr int kPoints = 3600;    // looked at of the plane
constexpr int kEnough = 2;       // places in the plane
constexpr double kNone = 1e-12;  // a residual as small is none

bool touches_curve(const CutSpace& space, const CutPlane& plane, double near_mm) {
  const auto is_on = [&](const Point& p) { return std::abs(plane.beyond_mm(p)) <= near_mm; };
  const std::vector<Corner> corners = space.inner.corners();
  if (std::any_of(corners.begin(), corners.end(), [&](const Corner& corner) { return is_on(corner.point); })) {
    return true;
  }
  const std::vector<std::shared_ptr<const Curve>> curves = space.inner.curves();
  return std::any_of(curves.begin(), curves.end(), [&](const std::shared_ptr<const Curve>& curve) {
    int found = 0;
    for (int n = 0; n < kPlaces && found < kEnough; ++n) {
      if (is_on(curve->at(curve->length_mm() * (n + 0.5) / kPlaces))) ++found;
    }
    return found >= kEnough;
  });
}

bool touches_surface(const CutSpace& space, std::size_t plane) {
  const std::vector<Point> polygon = space.polygon(plane);
  if (polygon.empty()) return false;
  const PlaneAxes axes(space.planes[plane], space.box.center());
  Box box;
  for (const Point& p : polygon) box.extend({axes.u_of(p), axes.v_of(p), 0});
  const Vec extent = box.extent();
  // Shares of a sequence that fills a square evenly (Roberts, R2).
  constexpr double kAcross = 0.7548776662466927;
  constexpr double kAlong = 0.5698402909980532;
  int found = 0;
  for (int n = 1; n <= kPoints && found < kEnough; ++n) {
    const Point p = axes.at(box.min.x + (n * kAcross - std::floor(n * kAcross)) * extent.x,
                            box.min.y + (n * kAlong - std::floor(n * kAlong)) * extent.y);
    const std::optional<double> residual = space.inner.residual_at(p);
    if (!residual) return false;
    if (*residual <= kNone && space.keeps(p, {plane, kNoPlane})) ++found;
  }
  return found >= kEnough;
}

}  // namespace

bool touches_boundary(const CutSpace& space, std::size_t plane, double near_mm) {
  return touches_curve(space, space.planes[plane], near_mm) || touches_surface(space, plane);
}

}  // namespace scantet
