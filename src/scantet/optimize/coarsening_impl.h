// Private: vertices are taken away where edges are too short.
#pragma once

#include <cstdint>
#include <span>

#include "scantet/base/progress.h"
#include "scantet/domain/domain.h"
#include "scantet/optimize/element_bounds.h"
#include "scantet/optimize/facet_judge_impl.h"
#include "scantet/optimize/tet_complex_impl.h"

namespace scantet::optimize {

/// How much is tried for an edge.
enum class Effort {
  contract,  ///< one of its vertices goes into a neighbour
  move       ///< or both are put together at a new place, which takes many times as long
};

/// Takes away vertices with edges that are shorter than the target, the shortest first, until none can be; those in
/// `held` stay. A vertex
/// goes along an edge that is too short, or no longer than facets typically are from the surface; so no place of the
/// boundary moves farther than that.
///
/// Bounds on tets are those of the complex's judge. facets: what is asked of boundary facets; null: nothing. Works on
/// the threads of base/parallel.h; asks the domain from all of them. Returns how many vertices went. Cancelled: what is
/// done so far stays. Guarantees: every new tet is positively oriented and keeps all bounds, as every new facet does;
/// the boundary keeps its topology, its facets are no farther from the domain's than improve() lets them be, its
/// vertices stay on it; the result does not depend on the number of threads.
std::uint64_t coarsen(TetComplex& complex, const Domain& domain, const FacetJudge* facets, const EdgeTarget& target,
                      std::span<const Box> held, Effort effort, Progress& progress);

}  // namespace scantet::optimize
