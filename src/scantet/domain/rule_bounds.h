// What the refinement rules ask of elements.
#pragma once

#include <optional>

#include "scantet/base/api.h"

namespace SCANTET_API scantet {

class Domain;

inline constexpr double kSmallElement =
    0.5;  ///< of what the size allows: elements with a smaller circumradius are small

/// Bounds of the rules R1, R2 and R3 (paper, section 3) beside the size; each > 0.
struct RuleBounds {
  double alpha = 1;              ///< surface Delaunay balls have radius ≤ alpha·σ(centre)
  double facet_radius_edge = 1;  ///< ϱ_f: circumradius / shortest edge of boundary facets; ≥ 1 for termination
  double cell_radius_edge = 2;   ///< ϱ_t: circumradius / shortest edge of tets; ≥ 2 for termination in practice
  std::optional<double> facet_distance_mm;  ///< bound on facet circumcentre to ball centre; none: no such bound
  /// ≥ 1: times ϱ_f and ϱ_t, for small elements. Where these are, an object has features smaller than the size; with
  /// the same bounds as elsewhere, half of all points would be there for shape alone (docs/algorithm.md, "The rules").
  double small_slack = 1.5;

  /// Times ϱ_f or ϱ_t that the ratio of an element may be. radius: its circumradius, where the size allows most; mm.
  double slack(double radius, double most) const { return radius < kSmallElement * most ? small_slack : 1; }
};

/// These bounds, as they are for this domain: where three regions or more meet at curves, balls that protect these make
/// small elements, and no element gets slack.
RuleBounds bounds_on(const Domain& domain, RuleBounds bounds);

}  // namespace scantet
