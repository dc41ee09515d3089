// Private: the Lipschitz radius of a sampled boundary.
#pragma once

#include <vector>

#include "scantet/domain/domain.h"

namespace scantet {

/// lr_k (paper, Definition 7) at the points of a sample, in mm; infinity where nothing bounds it. sample: in random
/// order, spacing_mm apart. Several threads.
std::vector<double> lipschitz_radii(const Domain& domain, const std::vector<Point>& sample, double spacing_mm,
                                    double k);

}  // namespace scantet
