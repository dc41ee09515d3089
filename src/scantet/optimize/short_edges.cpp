// Edges are met once for each tet around them. Few are short, so those alone are sorted and freed of repeats.
#include <algorithm>

#include "scantet/base/parallel.h"
#include "scantet/optimize/short_edges_impl.h"

namespace scantet::optimize {

std::vector<ShortEdge> short_edges(const TetMesh& mesh, const EdgeTarget& target) {
  constexpr std::size_t kGrain = 8192;
  const auto find = [&](std::size_t begin, std::size_t end, std::vector<ShortEdge>& found) {
    for (std::size_t t = begin; t < end; ++t) {
      Tet tet = mesh.tets[t];
      std::sort(tet.begin(), tet.end());
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = i + 1; j < 4; ++j) {
          const Point& p = mesh.vertices[tet[i]];
          const Point& q = mesh.vertices[tet[j]];
          const double length = distance(p, q);
          const Point middle = lerp(p, q, 0.5);
          if (!target.asks_more_than(length, middle)) continue;
          found.push_back({length / target.least_mm(middle), {tet[i], tet[j]}});
        }
      }
    }
  };
  std::vector<ShortEdge> edges = parallel_collect<ShortEdge>(mesh.tets.size(), kGrain, find);
  std::sort(edges.begin(), edges.end());
  const auto same = [](const ShortEdge& a, const ShortEdge& b) { return a.vertex == b.vertex; };
  edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
  return edges;
}

}  // namespace scantet::optimize
