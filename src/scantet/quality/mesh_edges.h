// Every edge of a mesh, once.
#pragma once

#include <functional>
#include <vector>

#include "scantet/base/tet_mesh.h"

namespace scantet {

/// Calls visit(v, neighbours) for each vertex v in ascending order, with its neighbours of larger id, ascending: each
/// edge of a tet comes up once. Vertices without such neighbours are left out.
/// Takes 24 bytes per tet while it runs. All vertex ids must be below vertices.size().
void for_each_edge_star(const TetMesh& mesh, const std::function<void(VertexId, const std::vector<VertexId>&)>& visit);

}  // namespace scantet
