#include "scantet/refine/boundary_link_impl.h"

namespace scantet::refine {
namespace {

/// Whether the edges form one closed path through each of their vertices.
bool is_one_cycle(std::vector<std::array<PointId, 2>>& edges) {
  if (edges.size() < 3) return false;
  // Unwind the path from the first edge: each step swaps the one edge that goes on into place.
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    std::size_t found = 0;
    for (std::size_t j = i + 1; j < edges.size(); ++j) {
      if (edges[j][0] != edges[i][1] && edges[j][1] != edges[i][1]) continue;
      if (++found > 1) return false;
      std::swap(edges[i + 1], edges[j]);
    }
    if (found == 0) return false;
    if (edges[i + 1][0] != edges[i][1]) std::swap(edges[i + 1][0], edges[i + 1][1]);
  }
  return edges.back()[1] == edges.front()[0];
}

}  // namespace

bool BoundaryLink::is_cycle_around(PointId v, const Triangulation& t) {
  t.star_of(v, star_);
  edges_.clear();
  for (const CellId c : star_) {
    const Cell& cell = t.cell(c);
    for (std::size_t i = 0; i < 4; ++i) {
      if (cell.vertex[i] == v || cell.neighbor[i] < 4 * c) continue;
      if (t.info(c).region == t.info(cell.neighbor[i] / 4).region) continue;
      std::array<PointId, 2> edge{};
      std::size_t n = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        if (k != i && cell.vertex[k] != v) edge[n++] = cell.vertex[k];
      }
      edges_.push_back(edge);
    }
  }
  return is_one_cycle(edges_);
}

}  // namespace scantet::refine
