// A face of the grid's box is spanned by two of the grid's axes. Names go to the axes by the permutation whose cosines
// have the largest sum.
#include "scantet/cuts/cut_plane.h"

#include <algorithm>
#include <cmath>

namespace scantet {
namespace {

const char* const kNames[3][2] = {
    {"border_right", "border_left"}, {"border_anterior", "border_posterior"}, {"border_inferior", "border_superior"}};

/// The unit normal of the faces that the axis runs across, in its direction.
Vec normal_across(const Frame& frame, int axis) {
  const Vec across = cross(frame.column((axis + 1) % 3), frame.column((axis + 2) % 3));
  const Vec normal = (1 / length(across)) * across;
  return dot(normal, frame.column(axis)) > 0 ? normal : -1 * normal;
}

/// The axis of the world that each axis of the grid stands for.
std::array<int, 3> world_axes(const std::array<Vec, 3>& normals) {
  std::array<int, 3> axes{0, 1, 2};
  std::array<int, 3> best = axes;
  double most = -1;
  do {
    double sum = 0;
    for (int n = 0; n < 3; ++n)
      sum += std::abs(normals[static_cast<std::size_t>(n)][axes[static_cast<std::size_t>(n)]]);
    if (sum <= most) continue;
    most = sum;
    best = axes;
  } while (std::next_permutation(axes.begin(), axes.end()));
  return best;
}

}  // namespace

/// The second step takes away what rounding has left of the first.
Point CutPlane::nearest(const Point& p) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(normal[axis]) != 1) continue;
    Point on_plane = p;
    on_plane[axis] = normal[axis] * offset_mm;
    return on_plane;
  }
  const Point near = p - beyond_mm(p) * normal;
  return near - beyond_mm(near) * normal;
}

std::vector<CutPlane> border_planes(const Frame& frame, const std::array<int, 3>& size) {
  return border_planes(frame, {0, 0, 0}, {size[0] - 1, size[1] - 1, size[2] - 1});
}

std::vector<CutPlane> border_planes(const Frame& frame, const std::array<int, 3>& first,
                                    const std::array<int, 3>& last) {
  const std::array<Vec, 3> normals{normal_across(frame, 0), normal_across(frame, 1), normal_across(frame, 2)};
  const std::array<int, 3> axes = world_axes(normals);
  std::vector<CutPlane> planes;
  for (std::size_t n = 0; n < 3; ++n) {
    const auto axis = static_cast<int>(n);
    for (const bool is_last : {false, true}) {
      Vec index;
      index[axis] = (is_last ? last : first)[n];
      const double sign = is_last ? 1 : -1;
      const Vec outward = sign * normals[n];
      const bool towards_more = outward[axes[n]] > 0;
      planes.push_back({outward, dot(outward, frame.to_world(index)), kNames[axes[n]][towards_more ? 1 : 0],
                        sign * frame.column(axis)});
    }
  }
  return planes;
}

}  // namespace scantet
