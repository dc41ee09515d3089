#include "scantet/cuts/continued_scan.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <variant>

#include "scantet/field/scan_from_memory.h"

namespace scantet {
namespace {

constexpr double kParallel = 1e-9;  // the sine of the angle between a plane and a layer
constexpr double kTouches = 1e-6;   // of a step: what else is beyond a plane may be beside an interface along it

/// The layers begin … end - 1 along an axis become as `last` is.
struct Continuation {
  std::size_t axis;
  int last;
  int begin;
  int end;
};

std::optional<Continuation> continuation_along(std::size_t axis, const Scan& scan, const CutPlane& plane) {
  const auto across = [&](std::size_t other) {
    const Vec& column = scan.frame.column(static_cast<int>(other));
    return std::abs(dot(plane.normal, column)) > kParallel * length(column);
  };
  if (across((axis + 1) % 3) || across((axis + 2) % 3)) return std::nullopt;
  const double step_mm = dot(plane.normal, scan.frame.column(static_cast<int>(axis)));
  const double at = -plane.beyond_mm(scan.frame.origin()) / step_mm;  // the plane, in layers from the first
  const int size = scan.size[axis];
  if (!(at > -1 && at < size)) return std::nullopt;  // there is nothing on one of its sides
  if (step_mm > 0) {
    const int last = std::min(static_cast<int>(std::floor(at + kTouches)), size - 1);
    return last < 0 ? std::nullopt : std::optional(Continuation{axis, last, last + 1, size});
  }
  const int last = std::max(static_cast<int>(std::ceil(at - kTouches)), 0);
  return last >= size ? std::nullopt : std::optional(Continuation{axis, last, 0, last});
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
      const std::optional<Continuation> how = continuation_along(axis, scan, plane);
      if (how && how->begin < how->end) all.push_back(*how);
    }
  }
  if (all.empty()) return scan;
  return std::visit([&](const auto* voxels) { return continued(scan, voxels, all); }, scan.voxels);
}

}  // namespace scantet
