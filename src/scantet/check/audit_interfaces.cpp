// The boundary facets by the pair of regions they lie between. Their edges are sorted by pair and vertices: facets of a
// pair that share an edge are one surface, and distinct edges are counted. A mesh of one region has one pair, of which
// everything is known by then.
#include <algorithm>
#include <map>

#include "scantet/check/audit_impl.h"

namespace scantet::auditing {
namespace {

using Pair = std::array<Region, 2>;

struct EdgeOfPair {
  Pair regions;
  VertexId from;
  VertexId to;
  std::uint32_t face;
  friend auto operator<=>(const EdgeOfPair&, const EdgeOfPair&) = default;

  bool is_same_edge(const EdgeOfPair& other) const {
    return regions == other.regions && from == other.from && to == other.to;
  }
};

struct VertexOfPair {
  Pair regions;
  VertexId vertex;
  friend auto operator<=>(const VertexOfPair&, const VertexOfPair&) = default;
};

Pair regions_of(const TetMesh& mesh, const BoundaryFace& face) {
  return {mesh.tet_regions[face.behind], face.front == kNone ? kOutside : mesh.tet_regions[face.front]};
}

double area_mm2(const TetMesh& mesh, const Triangle& v) {
  const Point& a = mesh.vertices[v[0]];
  return 0.5 * length(cross(mesh.vertices[v[1]] - a, mesh.vertices[v[2]] - a));
}

/// V - E + F of each pair's facets; those that share an edge and a pair are joined.
void count_elements(const TetMesh& mesh, const std::vector<BoundaryFace>& faces, std::map<Pair, MeshInterface>& counts,
                    ParallelUnionFind& surfaces) {
  std::vector<EdgeOfPair> edges;
  std::vector<VertexOfPair> vertices;
  edges.reserve(3 * faces.size());
  vertices.reserve(3 * faces.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const Triangle& v = faces[f].vertices;
    const Pair regions = regions_of(mesh, faces[f]);
    for (const auto& [from, to] : {std::pair{v[0], v[1]}, std::pair{v[0], v[2]}, std::pair{v[1], v[2]}}) {
      edges.push_back({regions, from, to, f});
    }
    for (const VertexId vertex : v) vertices.push_back({regions, vertex});
    MeshInterface& count = counts.try_emplace(regions, MeshInterface{regions}).first->second;
    ++count.facets;
    ++count.euler;
    count.area_mm2 += area_mm2(mesh, v);
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i > 0 && edges[i].is_same_edge(edges[i - 1])) {
      surfaces.unite(edges[i].face, edges[i - 1].face);
    } else {
      --counts.at(edges[i].regions).euler;
    }
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  for (const VertexOfPair& vertex : vertices) ++counts.at(vertex.regions).euler;
}

}  // namespace

void list_interfaces(const TetMesh& mesh, const FaceMatch& match, AuditReport& report) {
  const std::vector<BoundaryFace>& faces = match.boundary;
  if (faces.empty()) return;
  const Pair first = regions_of(mesh, faces.front());
  if (std::all_of(faces.begin(), faces.end(), [&](const auto& face) { return regions_of(mesh, face) == first; })) {
    double area = 0;
    for (const BoundaryFace& face : faces) area += area_mm2(mesh, face.vertices);
    report.interfaces = {{first, faces.size(), report.boundary_components, report.boundary_euler, area}};
    return;
  }
  std::map<Pair, MeshInterface> counts;
  ParallelUnionFind surfaces(faces.size());
  count_elements(mesh, faces, counts, surfaces);
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    if (surfaces.is_root(f)) ++counts.at(regions_of(mesh, faces[f])).surfaces;
  }
  for (const auto& [regions, count] : counts) report.interfaces.push_back(count);
}

}  // namespace scantet::auditing
