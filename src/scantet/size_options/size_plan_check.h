// Whether what a job asks of sizes fits what it meshes.
#pragma once

#include "scantet/plugin/input_plugin.h"
#include "scantet/size_options/size_plan.h"

namespace scantet {

/// Throws Error: usage.region_size, for a size in a region that the object does not have; usage.no_effect, for a number
/// on the boundary that is not less than the number inside.
void check_plan(const SizePlan& plan, const OpenedDomain& opened);

}  // namespace scantet
