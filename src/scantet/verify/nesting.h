// Which closed surfaces lie within which.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scantet/verify/boundary_rays.h"
#include "scantet/verify/shell.h"

namespace scantet::verify {

/// Of each component of a closed boundary without crossings: how many others are around it. Where that is even it
/// bounds a part of the inside from without, else a cavity, whichever way it is turned. None: could not be decided.
std::optional<std::vector<std::uint32_t>> nesting(const TetMesh& mesh, const Shell& shell, const BoundaryRays& rays);

}  // namespace scantet::verify
