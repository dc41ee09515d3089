// A point is probed at the corners, the middles of edges and faces, and the middle of a small cube around it.
#include "scantet/size_options/region_probe.h"

#include <algorithm>

#include "scantet/base/neighbors.h"

namespace scantet {
namespace {

constexpr double kFirstLook = 1.0 / 128;  // of the longest side of the bounds
constexpr double kProbe = 0.05;           // of the spacing: half of the cube's side

/// Whether is_it(region) holds for a region around a point of the boundary.
template <class IsIt>
bool any_region_around(const Domain& domain, const Point& p, double spacing_mm, const IsIt& is_it) {
  return std::any_of(kNeighborhood.begin(), kNeighborhood.end(), [&](const NeighborOffset& offset) {
    return is_it(domain.region_at(p + (kProbe * spacing_mm) * as_vec(offset)));
  });
}

}  // namespace

double first_look_mm(const Domain& domain) {
  const Vec extent = domain.bounds().extent();
  return kFirstLook * std::max({extent.x, extent.y, extent.z});
}

std::set<Region> regions_of(const Domain& domain) {
  std::set<Region> found;
  for (const Component& component : domain.components()) found.insert(component.region);
  if (found.empty()) {
    const double spacing_mm = first_look_mm(domain);
    domain.surface_candidates(spacing_mm, [&](const Point& p) {
      any_region_around(domain, p, spacing_mm, [&](Region region) {
        found.insert(region);
        return false;
      });
    });
  }
  found.erase(kOutside);
  return found;
}

Region region_beside(const Domain& domain, const Point& p, double spacing_mm) {
  Region found = kOutside;
  any_region_around(domain, p, spacing_mm, [&](Region region) { return (found = region) != kOutside; });
  return found;
}

}  // namespace scantet
