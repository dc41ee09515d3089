// Edges of curves are few: they are sorted, and each edge of a tet between two of their vertices is looked up.
#include <algorithm>
#include <limits>
#include <set>

#include "scantet/base/element_nodes.h"
#include "scantet/base/error.h"
#include "scantet/io/curve_elements_impl.h"

namespace scantet {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

struct NumberedEdge {
  std::array<VertexId, 2> ends;  ///< ascending
  std::uint32_t number = 0;
};

std::array<VertexId, 2> ascending(VertexId a, VertexId b) {
  return a < b ? std::array{a, b} : std::array{b, a};
}

bool is_before(const NumberedEdge& a, const NumberedEdge& b) {
  return a.ends < b.ends;
}

}  // namespace

CurveElements::CurveElements(const TetMesh& mesh)
    : nodes_(mesh.curve_edges.size()), tets_(mesh.curve_edges.size(), kNone) {
  if (mesh.curve_edges.empty()) return;
  std::vector<std::uint8_t> is_on_curve(mesh.vertices.size(), 0);
  std::vector<NumberedEdge> edges;
  for (std::uint32_t e = 0; e < mesh.curve_edges.size(); ++e) {
    const auto& [a, b] = mesh.curve_edges[e];
    is_on_curve[a] = is_on_curve[b] = 1;
    edges.push_back({ascending(a, b), e});
    nodes_[e].all = {a, b};
    nodes_[e].count = is_second_order(mesh) ? 3 : 2;
  }
  std::sort(edges.begin(), edges.end(), is_before);
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
    const Tet& tet = mesh.tets[t];
    for (std::size_t e = 0; e < 6; ++e) {
      const VertexId a = tet[kEdgesOfNodes[e][0]];
      const VertexId b = tet[kEdgesOfNodes[e][1]];
      if (is_on_curve[a] == 0 || is_on_curve[b] == 0) continue;
      const auto [first, last] = std::equal_range(edges.begin(), edges.end(), NumberedEdge{ascending(a, b)}, is_before);
      for (auto edge = first; edge != last; ++edge) {
        if (tets_[edge->number] != kNone) continue;
        tets_[edge->number] = t;
        if (is_second_order(mesh)) nodes_[edge->number].all[2] = mesh.tet_edge_vertices[t][e];
      }
    }
  }
  if (std::find(tets_.begin(), tets_.end(), kNone) == tets_.end()) return;
  throw Error(Fault::internal, "mesh.inconsistent",
              "the mesh to write is broken: an edge of a curve is not one of a tet");
}

std::vector<NamedSet> curves_as_sets(const TetMesh& mesh, const MeshTags& tags) {
  std::vector<NamedSet> sets;
  const CurveElements edges(mesh);
  for_each_curve(mesh, tags, [&](const CurveTag& curve, std::span<const std::uint32_t> members) {
    std::set<VertexId> nodes;
    for (const std::uint32_t edge : members) nodes.insert(edges.of(edge).begin(), edges.of(edge).end());
    sets.push_back({curve.name, {}});
    sets.back().set.vertices.assign(nodes.begin(), nodes.end());
  });
  if (!tags.corners) return sets;
  sets.push_back({tags.corners->name, {}});
  sets.back().set.vertices = mesh.corners;
  std::sort(sets.back().set.vertices.begin(), sets.back().set.vertices.end());
  return sets;
}

}  // namespace scantet
