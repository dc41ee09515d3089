// Each point that is found shortens the rays after it.
#include <algorithm>

#include "scantet/surface/boundary_around_impl.h"

namespace scantet::engine {

BoundaryAround boundary_around(const Domain& domain, const Point& place, std::span<const Vec> directions,
                               double reach_mm) {
  constexpr double kFarthest = 2;  // times as far as the nearest
  constexpr double kApart = 0.7;   // of the distance to the nearest
  BoundaryAround around{};
  Crossings crossings;
  for (const Vec& direction : directions) {
    domain.crossings({place, place + (reach_mm / length(direction)) * direction}, crossings);
    if (crossings.empty()) continue;
    around.points.push_back(crossings.front().point);
    reach_mm = std::min(reach_mm, kFarthest * distance(around.points.back(), place));
  }
  std::erase_if(around.points, [&](const Point& p) { return distance(p, place) > reach_mm; });
  around.apart_mm = kApart * reach_mm / kFarthest;
  return around;
}

}  // namespace scantet::engine
