// The rules on a finished sample, from scratch.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/domain/domain.h"
#include "scantet/domain/sizing_field.h"
#include "scantet/refine/mesh_result.h"
#include "scantet/refine/mesher_options.h"

namespace scantet {

/// Checks the rules on a finished sample from scratch: triangulates the points anew, asks the domain anew, and counts
/// the elements that violate R1, R2 or R3. Owes nothing to the bookkeeping of mesh_domain.
UnmetRules check_rules(const std::vector<Point>& sample, const std::vector<std::uint8_t>& dimensions,
                       const Domain& domain, const SizingField& size, const MesherOptions& options);

}  // namespace scantet
