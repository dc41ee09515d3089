// Where the boundary of a mesh meets itself.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/base/tet_mesh.h"

namespace scantet {

/// The places in mesh.boundary_facets, ascending, of facets that have points in common with another one beside the
/// corners and edges that the two share by their places: there the mesh overlaps itself, though all its tets are
/// positive. By exact signs; of two facets in one plane only those are found that fold over a common edge. Several
/// threads. Pre: ids are valid.
std::vector<std::uint32_t> crossing_facets(const TetMesh& mesh);

}  // namespace scantet
