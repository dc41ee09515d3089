// Private: sliver exudation (paper, section 7.2; reference [8]).
#pragma once

#include <cstdint>

#include "scantet/base/progress.h"
#include "scantet/optimize/tet_complex_impl.h"

namespace scantet::optimize {

/// Gives vertices weights so that tets that break a bound of the complex's judge leave the weighted Delaunay
/// triangulation, worst first, until no vertex of one or beyond one of its faces can be given a weight that helps.
///
/// complex: Delaunay, or nearly so, inside its boundary. Works on the threads of base/parallel.h. Returns how many
/// times a vertex was given a weight ("pumped"). Cancelled: what is done so far stays. Guarantees: no vertex moves or
/// goes; the boundary facets and regions stay as they are; every new tet is positively oriented; where tets are
/// replaced the sharpest gets less sharp, down to the bound; the result does not depend on the number of threads.
std::uint64_t exude(TetComplex& complex, Progress& progress);

}  // namespace scantet::optimize
