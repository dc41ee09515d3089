// A plane is fitted to the points around; two region queries tell which side of it is inside, asked for many planes at
// once.
#include "scantet/base/parallel.h"
#include "scantet/sampling/boundary_planes_impl.h"
#include "scantet/sampling/plane_fit_impl.h"

namespace scantet::engine {
namespace {

constexpr double kReach = 1.6;    // of alpha·σ: points that far count
constexpr double kProbe = 0.2;    // of alpha·σ: how far off the plane the region is asked for
constexpr int kMostPoints = 100;  // enough, where the sample is much finer than its spacing

std::optional<Vec> normal_at(const PointGrid& grid, const Point& p, double spacing_mm) {
  PlaneFit plane;
  const double reach = kReach * spacing_mm;
  int count = 0;
  grid.any_near(p, reach, [&](std::uint32_t, const Point& other, double squared) {
    const double fade = 1 - squared / (reach * reach);
    plane.add(other - p, fade * fade);
    return ++count == kMostPoints;
  });
  return plane.normal();
}

}  // namespace

BoundaryPlanes::BoundaryPlanes(const Domain& domain, const SizingField& size, double alpha,
                               const std::vector<Point>& sample)
    : grid_(sample, alpha * size.min_size()), inward_(sample.size()), is_interface_(sample.size()) {
  constexpr std::size_t kGrain = 256;
  parallel_for(sample.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> planes;
    std::vector<Point> probes;  // ahead of and behind each plane
    for (std::size_t k = begin; k < end; ++k) {
      const PointGrid::Entry& entry = grid_.entries()[k];
      const double spacing_mm = alpha * size.size_at(entry.point);
      const std::optional<Vec> normal = normal_at(grid_, entry.point, spacing_mm);
      if (!normal) continue;
      planes.push_back(entry.index);
      inward_[entry.index] = *normal;
      const Vec probe = (kProbe * spacing_mm) * *normal;
      probes.push_back(entry.point + probe);
      probes.push_back(entry.point - probe);
    }
    std::vector<Region> regions(probes.size());
    domain.regions_at(probes, regions);
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const Region ahead = regions[2 * i];
      const Region behind = regions[2 * i + 1];
      Vec& inward = inward_[planes[i]];
      if (ahead == behind) {
        inward = {};
      } else if (ahead == kOutside) {
        inward = -1.0 * inward;
      }
      is_interface_[planes[i]] = ahead != behind && ahead != kOutside && behind != kOutside ? 1 : 0;
    }
  });
}

}  // namespace scantet::engine
