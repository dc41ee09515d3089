// Whether facets of a mesh's boundary cross each other.
#pragma once

#include <vector>

#include "scantet/base/progress.h"
#include "scantet/verify/boundary_rays.h"

namespace scantet::verify {

/// Looks at all pairs of facets of which one has a fault (Collar::faults, one a facet); the others are apart as their
/// collars are. Adds crossings and what could not be decided to `found`. Return: whether no two facets cross, as far as
/// these pairs go.
bool check_crossings(const TetMesh& mesh, const Shell& shell, const BoundaryRays& rays,
                     const std::vector<std::uint8_t>& faults, std::vector<VerifyFinding>& found,
                     const Progress& progress);

}  // namespace scantet::verify
