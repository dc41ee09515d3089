// Hollows of a mesh that are turned inside out.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/base/tet_mesh.h"

namespace scantet {

/// The places in mesh.boundary_facets, ascending, of the facets of hollows that are turned over: tets lie over each
/// other in and around them, though all are positive and no two facets need cross. In what hangs together at vertices
/// one closed surface, the outermost, has a positive volume within, as its facets are oriented, and hollows have a
/// negative one; so all others with a positive one are turned. Parts that meet at a vertex count as one. Pre: ids are
/// valid.
std::vector<std::uint32_t> turned_hollows(const TetMesh& mesh);

}  // namespace scantet
