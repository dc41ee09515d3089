// Private: how deep points are under the boundary, from a sample of the boundary.
#pragma once

#include <optional>

#include "scantet/base/point_grid_impl.h"
#include "scantet/domain/domain.h"
#include "scantet/domain/sizing_field.h"

namespace scantet::engine {

/// The tangent planes of the boundary at the points of a sample.
class BoundaryPlanes {
 public:
  /// sample: of the boundary, alpha·σ dense.
  BoundaryPlanes(const Domain& domain, const SizingField& size, double alpha, const std::vector<Point>& sample);

  /// The points of the sample.
  const PointGrid& points() const { return grid_; }

  /// Whether there is a plane at a point of the sample: there is none where the points around lie on no clear one.
  bool has_plane(std::uint32_t index) const { return inward_[index] != Vec{}; }

  /// Unit normal of that plane; where it lies between two regions of the inside, towards one of them.
  const Vec& inward(std::uint32_t index) const { return inward_[index]; }

  /// Whether both sides of the plane are inside.
  bool is_interface(std::uint32_t index) const { return is_interface_[index] != 0; }

 private:
  PointGrid grid_;
  std::vector<Vec> inward_;  // one per point of the sample; zero where there is no plane
  std::vector<std::uint8_t> is_interface_;
};

}  // namespace scantet::engine
