#include "scantet/cuts/continued_scan.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "scantet/field/scan_from_memory.h"

namespace scantet {
namespace {

constexpr double kTilt = 0.1;      // of a step, across the image: headers have rotations that are none but for rounding
constexpr double kTouches = 1e-6;  // of a step

/// The layers begin … end - 1 along an axis become as `last` is.
struct Continuation {
  std::size_t axis;
  int last;
  int begin;
  int end;
};

/// Where the plane is, in layers from the first, in the corners of the image's layers: the lowest and the highest.
std::pair<double, double> range_along(std::size_t axis, const Scan& scan, const CutPlane& plane) {
  const auto column = [&](std::size_t n) { return scan.frame.column(static_cast<int>(n % 3)); };
  const auto last = [&](std::size_t n) { return scan.size[n % 3] - 1.0; };
  const double step_mm = dot(plane.normal, column(axis));
  std::pair range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double i : {0.0, last(axis + 1)}) {
    for (const double j : {0.0, last(axis + 2)}) {
      const Point corner = scan.frame.origin() + i * column(axis + 1) + j * column(axis + 2);
      const double at = -plane.beyond_mm(corner) / step_mm;
      range = {std::min(range.first, at), std::max(range.second, at)};
    }
  }
  return range;
}

/// None where the plane is not parallel to the layers across the axis, or all of them are on one of its sides.
std::optional<Continuation> continuation_along(std::size_t axis, const Scan& scan, const CutPlane& plane) {
  const auto [lowest, highest] = range_along(axis, scan, plane);
  if (!(highest - lowest <= kTilt)) return std::nullopt;
  const int size = scan.size[axis];
  const bool cuts_high = dot(plane.normal, scan.frame.column(static_cast<int>(axis))) > 0;
  const double before = cuts_high ? std::ceil(highest - kTouches) - 1 : std::floor(lowest + kTouches) + 1;
  const int last = static_cast<int>(std::clamp(before, -1.0, static_cast<double>(size)));
  if (last < 0 || last >= size) return std::nullopt;
  const Continuation how{axis, last, cuts_high ? last + 1 : 0, cuts_high ? size : last};
  return how.begin < how.end ? std::optional(how) : std::nullopt;
}

template <class Voxel>
void go_on(const Continuation& how, const std::array<int, 3>& size, std::vector<Voxel>& voxels) {
  std::size_t within = 1;  // voxels of a layer that follow each other
  for (std::size_t axis = 0; axis < how.axis; ++axis) within *= static_cast<std::size_t>(size[axis]);
  const std::size_t block = within * static_cast<std::size_t>(size[how.axis]);
  for (std::size_t at = 0; at < voxels.size(); at += block) {
    const auto layer = [&](int n) {
      return voxels.begin() + static_cast<std::ptrdiff_t>(at + static_cast<std::size_t>(n) * within);
    };
    for (int n = how.begin; n < how.end; ++n) std::copy_n(layer(how.last), within, layer(n));
  }
}

template <class Voxel>
Scan continued(const Scan& scan, const Voxel* voxels, const std::vector<Continuation>& all) {
  std::vector<Voxel> values(voxels, voxels + scan.voxel_count());
  for (const Continuation& how : all) go_on(how, scan.size, values);
  const auto kept = std::make_shared<const std::vector<Voxel>>(std::move(values));
  Scan result = scan;
  result.voxels = kept->data();
  result.owner = kept;
  look_at_voxels(result, "the scan", true);
  return result;
}

}  // namespace

Scan continued_beyond(const Scan& scan, const std::vector<CutPlane>& planes) {
  std::vector<Continuation> all;
  for (const CutPlane& plane : planes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (const auto how = continuation_along(axis, scan, plane)) all.push_back(*how);
    }
  }
  if (all.empty()) return scan;
  return std::visit([&](const auto* voxels) { return continued(scan, voxels, all); }, scan.voxels);
}

}  // namespace scantet
