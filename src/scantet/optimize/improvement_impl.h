// Private: what exudation leaves is reconnected, smoothed and, last, done without.
#pragma once

#include <cstdint>

#include "scantet/base/progress.h"
#include "scantet/domain/domain.h"
#include "scantet/optimize/facet_judge_impl.h"
#include "scantet/optimize/optimizer.h"
#include "scantet/optimize/tet_complex_impl.h"

namespace scantet::optimize {

/// Changes the mesh around tets and boundary facets that break a bound, worst first, until there are none or no
/// operation helps those that are left.
///
/// Bounds on tets are those of the complex's judge. facets: what is asked of boundary facets; null: nothing. bad: the
/// tets that break a bound and those behind facets that do. persistence: what is done about those that a first pass
/// leaves. Works on the threads of base/parallel.h; asks the domain from all of them. Returns how many changes were
/// made. Cancelled: what is done so far stays. Guarantees: every new tet is positively oriented; where elements change
/// the sharpest of them gets less sharp, down to the bound; boundary facets keep their topology and are no farther from
/// the domain's boundary than old ones beside them or typical ones are; boundary vertices stay on it, and those of
/// curves on their curves; where the boundary is pinched they stay where they are; the result does not depend on the
/// number of threads.
std::uint64_t improve(TetComplex& complex, const Domain& domain, const FacetJudge* facets, std::vector<TetId> bad,
                      Persistence persistence, Progress& progress);

}  // namespace scantet::optimize
