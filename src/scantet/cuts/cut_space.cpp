// The polygon is a square that the half-spaces cut one after the other (Sutherland and Hodgman).
#include "scantet/cuts/cut_space.h"

#include <algorithm>
#include <cassert>

#include "scantet/cuts/plane_axes.h"

namespace scantet {
namespace {

/// Cuts off what is beyond the plane.
void clip(std::vector<Point>& polygon, const CutPlane& plane) {
  std::vector<Point> left;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& here = polygon[i];
    const Point& next = polygon[(i + 1) % polygon.size()];
    const double a = plane.beyond_mm(here);
    const double b = plane.beyond_mm(next);
    if (a < 0) left.push_back(here);
    if ((a < 0) != (b < 0)) left.push_back(lerp(here, next, a / (a - b)));
  }
  polygon = std::move(left);
}

}  // namespace

bool CutSpace::keeps(const Point& p, const std::array<std::size_t, 2>& but) const {
  for (std::size_t k = 0; k < planes.size(); ++k) {
    if (k != but[0] && k != but[1] && planes[k].beyond_mm(p) >= 0) return false;
  }
  return true;
}

std::optional<KeptStretch> CutSpace::kept(const Segment& segment, const std::array<std::size_t, 2>& but) const {
  KeptStretch stretch;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    if (k == but[0] || k == but[1]) continue;
    const double a = planes[k].beyond_mm(segment.source);
    const double b = planes[k].beyond_mm(segment.target);
    if (a < 0 && b < 0) continue;
    if (a >= 0 && b >= 0) return std::nullopt;
    const double place = a / (a - b);
    if (a >= 0 && (place >= stretch.enter || stretch.enter_plane == kNoPlane)) {
      stretch.enter = place;
      stretch.enter_plane = k;
    }
    if (b >= 0 && (place <= stretch.leave || stretch.leave_plane == kNoPlane)) {
      stretch.leave = place;
      stretch.leave_plane = k;
    }
  }
  const bool is_cut_twice = stretch.enter_plane != kNoPlane && stretch.leave_plane != kNoPlane;
  if (is_cut_twice && !(stretch.enter < stretch.leave)) return std::nullopt;
  assert(0 <= stretch.enter && stretch.enter <= stretch.leave && stretch.leave <= 1);
  return stretch;
}

std::vector<Point> CutSpace::polygon(std::size_t plane) const {
  const PlaneAxes axes(planes[plane], box.center());
  const double reach = box.diagonal();
  std::vector<Point> polygon{axes.at(-reach, -reach), axes.at(reach, -reach), axes.at(reach, reach),
                             axes.at(-reach, reach)};
  for (int axis = 0; axis < 3; ++axis) {
    Vec normal;
    normal[axis] = 1;
    clip(polygon, {normal, box.max[axis], {}});
    clip(polygon, {-1 * normal, -box.min[axis], {}});
  }
  for (std::size_t k = 0; k < planes.size(); ++k) {
    if (k != plane) clip(polygon, planes[k]);
  }
  return polygon;
}

}  // namespace scantet
