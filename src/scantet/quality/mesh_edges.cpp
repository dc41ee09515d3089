// A counting sort of all 6 edges of all tets on their smaller end; each bucket is then sorted and freed of repeats.
#include "scantet/quality/mesh_edges.h"

#include <algorithm>
#include <utility>

#include "scantet/quality/measures.h"

namespace scantet {
namespace {

std::pair<VertexId, VertexId> edge_of(const Tet& tet, const std::array<int, 2>& edge) {
  return std::minmax(tet[static_cast<std::size_t>(edge[0])], tet[static_cast<std::size_t>(edge[1])]);
}

}  // namespace

void for_each_edge_star(const TetMesh& mesh, const std::function<void(VertexId, const std::vector<VertexId>&)>& visit) {
  std::vector<std::size_t> first(mesh.vertices.size() + 1, 0);
  for (const Tet& tet : mesh.tets) {
    for (const auto& edge : kTetEdges) ++first[edge_of(tet, edge).first + 1];
  }
  for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
  std::vector<VertexId> larger(first.back());
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  for (const Tet& tet : mesh.tets) {
    for (const auto& edge : kTetEdges) {
      const auto [small, large] = edge_of(tet, edge);
      larger[next[small]++] = large;
    }
  }
  std::vector<VertexId> neighbours;
  for (std::size_t v = 0; v + 1 < first.size(); ++v) {
    if (first[v] == first[v + 1]) continue;
    neighbours.assign(larger.begin() + static_cast<std::ptrdiff_t>(first[v]),
                      larger.begin() + static_cast<std::ptrdiff_t>(first[v + 1]));
    std::sort(neighbours.begin(), neighbours.end());
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    visit(static_cast<VertexId>(v), neighbours);
  }
}

}  // namespace scantet
