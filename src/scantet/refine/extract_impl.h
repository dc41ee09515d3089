// Private: from the triangulation to plain arrays.
#pragma once

#include "scantet/base/tet_mesh.h"
#include "scantet/surface/restricted_triangulation_impl.h"

namespace scantet::engine {

/// The mesh: the cells whose circumcentre is inside, in their order; their vertices, along a space-filling curve; and
/// their boundary, in the order of its vertices.
TetMesh extract_mesh(const RestrictedTriangulation& triangulation);

}  // namespace scantet::engine
