// Whether a mesh can be verified at all.
#pragma once

#include "scantet/base/tet_mesh.h"

namespace scantet::verify {

/// Throws Error: input.no_tets, mesh.inconsistent (Fault::internal), input.range (coordinates beyond 1e50).
void check_mesh(const TetMesh& mesh);

}  // namespace scantet::verify
