// The regions that meet at curves, as ascending lists.
#pragma once

#include <algorithm>
#include <iterator>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "scantet/domain/curve.h"

namespace scantet {

/// Adds to ascending regions those of others, ascending too, that they lack.
inline void unite_regions(std::vector<Region>& regions, std::span<const Region> others) {
  if (std::includes(regions.begin(), regions.end(), others.begin(), others.end())) return;
  std::vector<Region> all;
  std::set_union(regions.begin(), regions.end(), others.begin(), others.end(), std::back_inserter(all));
  regions = std::move(all);
}

/// The regions around a curve, each once, ascending.
inline std::vector<Region> regions_at(const Curve& curve) {
  std::vector<Region> regions = curve.regions();
  std::sort(regions.begin(), regions.end());
  regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
  return regions;
}

/// Whether three regions or more meet at one of the curves: others are rims and edges of what is on one side of them.
inline bool have_junctions(std::span<const std::shared_ptr<const Curve>> curves) {
  return std::any_of(curves.begin(), curves.end(),
                     [](const std::shared_ptr<const Curve>& curve) { return regions_at(*curve).size() > 2; });
}

}  // namespace scantet
