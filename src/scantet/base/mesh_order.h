// Meshes of second order, seen as meshes of first order.
#pragma once

#include "scantet/base/api.h"
#include "scantet/base/tet_mesh.h"

namespace SCANTET_API scantet {

/// The corners of a mesh of second order and the straight tets between them, boundary, patches and curves derived anew:
/// what is measured, audited and verified of such a mesh. Sets, fields and materials are left out. Tets keep their
/// order, and corners theirs.
TetMesh first_order(const TetMesh& mesh);

}  // namespace scantet
