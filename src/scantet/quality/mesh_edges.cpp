// The neighbours in all tets at a vertex are freed of repeats and sorted.
#include "scantet/quality/mesh_edges.h"

#include <algorithm>

#include "scantet/base/repeats.h"

namespace scantet {

void for_each_edge_star(const TetMesh& mesh, const TetStars& stars, std::size_t begin, std::size_t end,
                        const std::function<void(VertexId, const std::vector<VertexId>&)>& visit) {
  std::vector<VertexId> neighbours;
  for (std::size_t v = begin; v < end; ++v) {
    neighbours.clear();
    for (const std::uint32_t tet : stars.of(v)) {
      for (const VertexId w : mesh.tets[tet]) {
        if (w > v) neighbours.push_back(w);
      }
    }
    if (neighbours.empty()) continue;
    drop_repeats(neighbours);
    std::sort(neighbours.begin(), neighbours.end());
    visit(static_cast<VertexId>(v), neighbours);
  }
}

}  // namespace scantet
