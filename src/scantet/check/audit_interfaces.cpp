// The boundary facets by the pair of regions they lie between. Their edges are sorted by pair and vertices: facets of a
// pair that share an edge are one surface, and distinct edges are counted. A mesh of one region has one pair, of which
// everything is known by then.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

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

/// Adds a facet's area, angles and edges; the means are sums until all are there.
void add_shape(const TetMesh& mesh, const Triangle& v, MeshInterface& sum) {
  double least = 180;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec along = mesh.vertices[v[(i + 1) % 3]] - mesh.vertices[v[i]];
    const Vec other = mesh.vertices[v[(i + 2) % 3]] - mesh.vertices[v[i]];
    const double twice_area = length(cross(along, other));
    if (i == 0) sum.area_mm2 += 0.5 * twice_area;
    least = std::min(least, std::atan2(twice_area, dot(along, other)) * 180 / std::numbers::pi);
    const double edge = length(along);
    sum.min_edge_mm = std::min(sum.min_edge_mm, edge);
    sum.mean_edge_mm += edge;
  }
  sum.min_angle_deg = std::min(sum.min_angle_deg, least);
  sum.mean_angle_deg += least;
}

MeshInterface no_facets_yet(const Pair& regions) {
  MeshInterface interface { regions };
  interface.min_angle_deg = 180;
  interface.min_edge_mm = std::numeric_limits<double>::infinity();
  return interface;
}

void make_means(MeshInterface& sum) {
  const auto facets = static_cast<double>(sum.facets);
  sum.mean_angle_deg /= facets;
  sum.mean_edge_mm /= 3 * facets;
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
    MeshInterface& count = counts.try_emplace(regions, no_facets_yet(regions)).first->second;
    ++count.facets;
    ++count.euler;
    add_shape(mesh, v, count);
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
    MeshInterface only = no_facets_yet(first);
    only.facets = faces.size();
    only.surfaces = report.boundary_components;
    only.euler = report.boundary_euler;
    for (const BoundaryFace& face : faces) add_shape(mesh, face.vertices, only);
    make_means(only);
    report.interfaces = {only};
    return;
  }
  std::map<Pair, MeshInterface> counts;
  ParallelUnionFind surfaces(faces.size());
  count_elements(mesh, faces, counts, surfaces);
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    if (surfaces.is_root(f)) ++counts.at(regions_of(mesh, faces[f])).surfaces;
  }
  for (auto& [regions, count] : counts) {
    make_means(count);
    report.interfaces.push_back(count);
  }
}

}  // namespace scantet::auditing
