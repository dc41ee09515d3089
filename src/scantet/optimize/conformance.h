// Which of the mesher's rules a finished mesh satisfies: reconnecting tets and moving vertices may break them.
#pragma once

#include <cstdint>
#include <optional>

#include "scantet/base/tet_mesh.h"
#include "scantet/domain/domain.h"
#include "scantet/domain/sizing_field.h"

namespace scantet {

/// What the rules ask for (paper, section 3); each > 0.
struct RuleBounds {
  double alpha = 1;                         ///< surface balls have radius ≤ alpha·σ(centre)
  double facet_radius_edge = 1;             ///< ϱ_f: circumradius / shortest edge of boundary facets
  double cell_radius_edge = 2;              ///< ϱ_t: circumradius / shortest edge of tets
  std::optional<double> facet_distance_mm;  ///< bound on facet circumcentre to ball centre
};

/// How many elements break each rule. An element that breaks two is counted under both.
struct RuleConformance {
  std::uint64_t r1 = 0;      ///< boundary facets with a vertex off the boundary, or radius-edge ratio > ϱ_f
  std::uint64_t r2 = 0;      ///< boundary facets whose surface ball is too large, too far away or missing
  std::uint64_t r3 = 0;      ///< tets with circumradius > σ(circumcentre) or radius-edge ratio > ϱ_t
  std::uint64_t facets = 0;  ///< boundary facets in all
  std::uint64_t tets = 0;    ///< tets in all

  friend bool operator==(const RuleConformance&, const RuleConformance&) = default;
};

/// Counts the elements of the mesh that break the rules, as the mesh is: which points it was once the Delaunay
/// triangulation of does not matter.
///
/// The surface ball of a facet is centred where its axis, the line through its circumcentre along its normal, crosses
/// the boundary of the domain nearest to the circumcentre, and goes through its vertices; it is missing if that is
/// nowhere within alpha·σ(circumcentre). Bounds may be exceeded by 1e-9 of themselves, for rounding. A degenerate
/// element breaks every rule that asks for its circumcentre. domain and size: what the mesh was made from; asked from
/// several threads at once. Pre: as TetMesh promises. Guarantees: does not depend on the number of threads. Takes one
/// query of the domain a boundary facet.
RuleConformance check_conformance(const TetMesh& mesh, const Domain& domain, const SizingField& size,
                                  const RuleBounds& bounds);

}  // namespace scantet
