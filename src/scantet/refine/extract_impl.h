// Private: from the triangulation to plain arrays.
#pragma once

#include "scantet/base/tet_mesh.h"
#include "scantet/refine/restricted_triangulation_impl.h"

namespace scantet::refine {

/// The cells whose circumcentre is inside, their vertices and their boundary, in an order that depends on geometry
/// only: vertices along a space-filling curve, tets and facets by their vertices.
TetMesh extract_mesh(const RestrictedTriangulation& triangulation);

}  // namespace scantet::refine
