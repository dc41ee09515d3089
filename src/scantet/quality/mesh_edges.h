// Every edge of a mesh, once.
#pragma once

#include <functional>
#include <vector>

#include "scantet/base/tet_mesh.h"
#include "scantet/quality/tet_stars.h"

namespace scantet {

/// Calls visit(v, neighbours) for each vertex v of [begin, end) in ascending order, with its neighbours of larger id,
/// ascending: each edge of a tet comes up once. Vertices without such neighbours are left out. stars: of the mesh.
void for_each_edge_star(const TetMesh& mesh, const TetStars& stars, std::size_t begin, std::size_t end,
                        const std::function<void(VertexId, const std::vector<VertexId>&)>& visit);

}  // namespace scantet
