// A plane is fitted to the points around; two region queries tell which side of it is inside.
#include "scantet/base/parallel.h"
#include "scantet/sampling/boundary_planes_impl.h"
#include "scantet/sampling/plane_fit_impl.h"

namespace scantet::engine {
namespace {

constexpr double kReach = 1.6;    // of alpha·σ: points that far count
constexpr double kProbe = 0.2;    // of alpha·σ: how far off the plane the region is asked for
constexpr int kMostPoints = 100;  // enough, where the sample is much finer than its spacing

struct Plane {
  Vec inward;
  bool is_interface = false;
};

Plane tangent_plane(const Domain& domain, const PointGrid& grid, const Point& p, double spacing_mm) {
  PlaneFit plane;
  const double reach = kReach * spacing_mm;
  int count = 0;
  grid.any_near(p, reach, [&](std::uint32_t, const Point& other, double squared) {
    const double fade = 1 - squared / (reach * reach);
    plane.add(other - p, fade * fade);
    return ++count == kMostPoints;
  });
  const std::optional<Vec> normal = plane.normal();
  if (!normal) return {};
  const Vec probe = (kProbe * spacing_mm) * *normal;
  const Region ahead = domain.region_at(p + probe);
  const Region behind = domain.region_at(p - probe);
  if (ahead == behind) return {};
  return {ahead != kOutside ? *normal : -1.0 * *normal, ahead != kOutside && behind != kOutside};
}

}  // namespace

BoundaryPlanes::BoundaryPlanes(const Domain& domain, const SizingField& size, double alpha,
                               const std::vector<Point>& sample)
    : grid_(sample, alpha * size.min_size()), inward_(sample.size()), is_interface_(sample.size()) {
  constexpr std::size_t kGrain = 256;
  parallel_for(sample.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const PointGrid::Entry& entry = grid_.entries()[k];
      const Plane plane = tangent_plane(domain, grid_, entry.point, alpha * size.size_at(entry.point));
      inward_[entry.index] = plane.inward;
      is_interface_[entry.index] = plane.is_interface ? 1 : 0;
    }
  });
}

}  // namespace scantet::engine
