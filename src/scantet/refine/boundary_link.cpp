// The edges of a vertex' boundary facets that lie across from it are its link; the facets form a disk with the vertex
// inside if and only if the link is one closed path.
#include "scantet/base/parallel.h"
#include "scantet/refine/boundary_link_impl.h"

namespace scantet::refine {
namespace {

using LinkEdge = std::array<PointId, 2>;

/// Whether the edges form one closed path through each of their vertices. Reorders them.
bool is_one_cycle(LinkEdge* edges, std::size_t count) {
  if (count < 3) return false;
  // Unwind the path from the first edge: each step swaps the one edge that goes on into place.
  for (std::size_t i = 0; i + 1 < count; ++i) {
    std::size_t found = 0;
    for (std::size_t j = i + 1; j < count; ++j) {
      if (edges[j][0] != edges[i][1] && edges[j][1] != edges[i][1]) continue;
      if (++found > 1) return false;
      std::swap(edges[i + 1], edges[j]);
    }
    if (found == 0) return false;
    if (edges[i + 1][0] != edges[i][1]) std::swap(edges[i + 1][0], edges[i + 1][1]);
  }
  return edges[count - 1][1] == edges[0][0];
}

/// Calls visit(vertex, link edge) for the vertices on ∂O without a known disk, once for each of their facets.
template <class Visit>
void each_link_edge(const Triangulation& t, const std::vector<FacetCode>& facets, Visit visit) {
  for (const FacetCode facet : facets) {
    const auto v = facet_vertices(t.cell(facet / 4), static_cast<int>(facet % 4));
    for (std::size_t i = 0; i < 3; ++i) {
      const Vertex& vertex = t.vertex(v[i]);
      if (vertex.on_boundary && !vertex.has_disk) visit(v[i], LinkEdge{v[(i + 1) % 3], v[(i + 2) % 3]});
    }
  }
}

}  // namespace

std::vector<FacetCode> boundary_facets(const Triangulation& t) {
  constexpr std::size_t kGrain = 8192;
  return parallel_collect<FacetCode>(t.cell_slots(), kGrain,
                                     [&](std::size_t begin, std::size_t end, std::vector<FacetCode>& facets) {
                                       for (auto c = static_cast<CellId>(begin); c < end; ++c) {
                                         if (!t.is_cell(c) || t.info(c).region == kOutside) continue;
                                         for (std::uint32_t i = 0; i < 4; ++i) {
                                           const Region beyond = t.info(t.cell(c).neighbor[i] / 4).region;
                                           if (beyond == kOutside || t.info(c).region < beyond)
                                             facets.push_back(4 * c + i);
                                         }
                                       }
                                     });
}

void check_disks(Triangulation& t, const std::vector<FacetCode>& facets, const std::function<void(PointId)>& broken) {
  std::vector<std::uint32_t> ends(t.vertex_slots() + 1, 0);  // of each vertex' edges
  each_link_edge(t, facets, [&](PointId v, const LinkEdge&) { ++ends[v + 1]; });
  for (std::size_t v = 1; v < ends.size(); ++v) ends[v] += ends[v - 1];
  std::vector<LinkEdge> edges(ends.back());
  std::vector<std::uint32_t> next(ends.begin(), ends.end() - 1);
  each_link_edge(t, facets, [&](PointId v, const LinkEdge& edge) { edges[next[v]++] = edge; });
  parallel_for(t.vertex_slots(), kLinkGrain, [&](std::size_t begin, std::size_t end) {
    for (auto v = static_cast<PointId>(begin); v < end; ++v) {
      if (!t.is_vertex(v) || !t.vertex(v).on_boundary || t.vertex(v).has_disk) continue;
      t.vertex(v).has_disk = is_one_cycle(edges.data() + ends[v], ends[v + 1] - ends[v]);
      if (!t.vertex(v).has_disk) broken(v);
    }
  });
}

}  // namespace scantet::refine
