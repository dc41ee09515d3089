// Regions by what users call them.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/domain/domain.h"
#include "scantet/size_options/size_plan.h"

namespace SCANTET_PROGRAM_API scantet {

/// The plan with its named regions under their numbers. Throws Error (usage.region_size): no region of the domain is
/// called so, or two are; a region has two sizes.
SizePlan plan_with_numbers(const SizePlan& plan, const Domain& domain);

/// The regions that --layers is about. Throws Error (usage.layers): there is no such region.
std::set<Region> regions_in_layers(const LayerRequest& request, const Domain& domain);

}  // namespace scantet
