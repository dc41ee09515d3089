// A counting sort of all 6 edges of all tets on their smaller end; each bucket is then freed of repeats and sorted.
#include "scantet/quality/mesh_edges.h"

#include <algorithm>
#include <utility>

#include "scantet/base/parallel.h"
#include "scantet/base/repeats.h"
#include "scantet/quality/measures.h"

namespace scantet {
namespace {

/// Calls visit(smaller end, larger end) for all edges of all tets, on several threads.
template <class Visit>
void each_edge(const TetMesh& mesh, const Visit& visit) {
  constexpr std::size_t kTets = 16384;
  parallel_for(mesh.tets.size(), kTets, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Tet& tet = mesh.tets[i];
      for (const auto& edge : kTetEdges) {
        const auto [small, large] =
            std::minmax(tet[static_cast<std::size_t>(edge[0])], tet[static_cast<std::size_t>(edge[1])]);
        visit(small, large);
      }
    }
  });
}

}  // namespace

EdgeStars::EdgeStars(const TetMesh& mesh) : of_vertex_(mesh.vertices.size()), larger_(6 * mesh.tets.size()) {
  each_edge(mesh, [&](VertexId small, VertexId) { of_vertex_.count(small); });
  of_vertex_.close();
  each_edge(mesh, [&](VertexId small, VertexId large) { larger_[of_vertex_.place(small)] = large; });
}

void EdgeStars::visit(std::size_t begin, std::size_t end,
                      const std::function<void(VertexId, const std::vector<VertexId>&)>& visit) const {
  std::vector<VertexId> neighbours;
  for (std::size_t v = begin; v < end; ++v) {
    if (of_vertex_.begin(v) == of_vertex_.end(v)) continue;
    neighbours.assign(larger_.begin() + static_cast<std::ptrdiff_t>(of_vertex_.begin(v)),
                      larger_.begin() + static_cast<std::ptrdiff_t>(of_vertex_.end(v)));
    drop_repeats(neighbours);
    std::sort(neighbours.begin(), neighbours.end());
    visit(static_cast<VertexId>(v), neighbours);
  }
}

}  // namespace scantet
