// Whether facets of a mesh's boundary cross each other.
#pragma once

#include <vector>

#include "scantet/verify/collar.h"

namespace scantet::verify {

/// Looks at all pairs of facets of which one is not certified (Collar::faults); the others are apart as their collars
/// are. Adds crossings and what could not be decided to `found`. Return: whether no two facets cross, as far as these
/// pairs go.
bool check_crossings(const CollarInput& input, const Collar& collar, std::vector<VerifyFinding>& found,
                     const Progress& progress);

}  // namespace scantet::verify
