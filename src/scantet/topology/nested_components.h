// The components of the regions between nested level sets, from those of the level sets.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "scantet/domain/domain.h"

namespace scantet {

/// Every component of every region, region by region, then the cavities of the outermost level. nested: the levels as
/// one domain, of which region_at and crossings are asked; levels: outermost first, with components() and patches
/// numbered as in LevelTopology. Volumes are those of grid nodes, as there. Left out: components without volume, and
/// those so thin that no point could be found in them.
std::vector<Component> nested_components(const Domain& nested, std::span<const std::unique_ptr<Domain>> levels);

}  // namespace scantet
