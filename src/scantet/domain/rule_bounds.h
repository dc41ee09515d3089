// What the refinement rules ask of elements.
#pragma once

#include <optional>

#include "scantet/base/api.h"

namespace SCANTET_API scantet {

/// Bounds of the rules R1, R2 and R3 (paper, section 3) beside the size; each > 0.
struct RuleBounds {
  double alpha = 1;              ///< surface Delaunay balls have radius ≤ alpha·σ(centre)
  double facet_radius_edge = 1;  ///< ϱ_f: circumradius / shortest edge of boundary facets; ≥ 1 for termination
  double cell_radius_edge = 2;   ///< ϱ_t: circumradius / shortest edge of tets; ≥ 2 for termination in practice
  std::optional<double> facet_distance_mm;  ///< bound on facet circumcentre to ball centre; none: no such bound
};

}  // namespace scantet
