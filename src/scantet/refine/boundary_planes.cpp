// A plane is fitted to the points around; two region queries tell which side of it is inside.
#include "scantet/base/parallel.h"
#include "scantet/refine/boundary_planes_impl.h"
#include "scantet/refine/plane_fit_impl.h"

namespace scantet::refine {
namespace {

constexpr double kReach = 1.6;    // of alpha·σ: points that far count
constexpr double kProbe = 0.2;    // of alpha·σ: how far off the plane the region is asked for
constexpr int kMostPoints = 100;  // enough, where the sample is much finer than its spacing

Vec inward_normal(const Domain& domain, const PointGrid& grid, const Point& p, double spacing_mm) {
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
  const bool inside = domain.region_at(p + probe) != kOutside;
  if (inside == (domain.region_at(p - probe) != kOutside)) return {};
  return inside ? *normal : -1.0 * *normal;
}

}  // namespace

BoundaryPlanes::BoundaryPlanes(const Domain& domain, const SizingField& size, double alpha,
                               const std::vector<Point>& sample)
    : grid_(sample, alpha * size.min_size()), inward_(sample.size()) {
  constexpr std::size_t kGrain = 256;
  parallel_for(sample.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const PointGrid::Entry& entry = grid_.entries()[k];
      inward_[entry.index] = inward_normal(domain, grid_, entry.point, alpha * size.size_at(entry.point));
    }
  });
}

}  // namespace scantet::refine
