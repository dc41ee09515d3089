// Whether two level sets on one grid have the same components.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/field/height_grid.h"

namespace scantet {

/// The nodes by which components of either side, as LevelTopology has them, differ between two fields: those of a
/// component that another takes in, all but the largest pieces of one that comes apart, and components of nodes that
/// have all changed sides; as numbers of PaddedNodes, ascending. Empty if nodes that have not changed sides are in the
/// same components before and after, and there are no others. Nodes at the level do not count.
std::vector<std::int64_t> differing_components(const HeightGrid& before, const HeightGrid& after,
                                               const Progress& progress);

}  // namespace scantet
