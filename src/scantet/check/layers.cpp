// A search along edges from each vertex of the boundary, breadth first, that goes on through inner vertices alone: a
// way along the boundary is found, shorter, from the vertex where it leaves that.
#include "scantet/check/layers.h"

#include <algorithm>
#include <unordered_map>

#include "scantet/base/parallel.h"

namespace scantet {
namespace {

constexpr double kOpposite = 0.7;  // cosine between the normal of one side and that back of the other
constexpr double kInward = 0.5;    // cosine between the way across and the inward normal
constexpr std::size_t kPiece = 2048;

/// A region of the mesh: its edges, and its outward normals where it ends.
class RegionEdges {
 public:
  RegionEdges(const TetMesh& mesh, Region region) : mesh_(mesh) {
    for (std::size_t i = 0; i < mesh.boundary_facets.size(); ++i) {
      const auto& [behind, front] = mesh.facet_regions[i];
      if (behind == region) add_normal(mesh.boundary_facets[i], 1);
      if (front == region) add_normal(mesh.boundary_facets[i], -1);
    }
    for (auto& [vertex, normal] : normals_) {
      const double size = length(normal);
      if (size > 0) normal = (1 / size) * normal;
      boundary_.push_back(vertex);
    }
    std::sort(boundary_.begin(), boundary_.end());
    list_edges(region);
  }

  /// The vertices on its boundary, ascending.
  const std::vector<VertexId>& boundary() const { return boundary_; }

  /// The fewest edges, below `layers`, from a boundary vertex to the other side, and the middle of the way; layers if
  /// there is no such way.
  ThinPlace across(VertexId from, int layers, double thinnest_mm) const {
    const Vec& normal = normals_.at(from);
    std::vector<VertexId> seen{from};
    std::size_t begin = 0;
    for (int depth = 1; depth < layers; ++depth) {
      const std::size_t end = seen.size();
      for (std::size_t n = begin; n < end; ++n) {
        if (n > 0 && normals_.contains(seen[n])) continue;
        const VertexId at = seen[n];
        for (std::size_t e = first_[at]; e < first_[at + 1]; ++e) {
          const VertexId next = ends_[e];
          if (std::find(seen.begin(), seen.end(), next) != seen.end()) continue;
          seen.push_back(next);
          if (is_across(from, next, normal, thinnest_mm)) {
            return {lerp(mesh_.vertices[from], mesh_.vertices[next], 0.5), depth};
          }
        }
      }
      begin = end;
    }
    return {mesh_.vertices[from], layers};
  }

 private:
  void add_normal(const Triangle& facet, double sign) {
    const Point& a = mesh_.vertices[facet[0]];
    const Vec normal = sign * cross(mesh_.vertices[facet[1]] - a, mesh_.vertices[facet[2]] - a);
    for (const VertexId v : facet) {
      Vec& sum = normals_[v];
      sum = sum + normal;
    }
  }

  void list_edges(Region region) {
    std::vector<std::pair<VertexId, VertexId>> edges;
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      if (mesh_.tet_regions[t] != region) continue;
      for (const VertexId a : mesh_.tets[t]) {
        for (const VertexId b : mesh_.tets[t]) {
          if (a != b) edges.emplace_back(a, b);
        }
      }
    }
    parallel_sort(edges, std::less<>());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    first_.assign(mesh_.vertices.size() + 1, 0);
    for (const auto& [a, b] : edges) {
      ++first_[a + 1];
      ends_.push_back(b);
    }
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  }

  bool is_across(VertexId from, VertexId to, const Vec& normal, double thinnest_mm) const {
    const auto other = normals_.find(to);
    if (other == normals_.end() || dot(other->second, normal) > -kOpposite) return false;
    const Vec way = mesh_.vertices[to] - mesh_.vertices[from];
    const double size = length(way);
    return size >= thinnest_mm && -dot(way, normal) >= kInward * size;
  }

  const TetMesh& mesh_;
  std::unordered_map<VertexId, Vec> normals_;  // of boundary vertices, outward
  std::vector<VertexId> boundary_;
  std::vector<std::size_t> first_;  // of each vertex its first edge's place in ends_; one more at the end
  std::vector<VertexId> ends_;
};

}  // namespace

LayerCheck check_layers(const TetMesh& mesh, const std::set<Region>& regions, int layers, double thinnest_mm) {
  LayerCheck check;
  for (const Region region : regions) {
    const RegionEdges edges(mesh, region);
    const std::vector<VertexId>& boundary = edges.boundary();
    const auto found = parallel_collect<ThinPlace>(
        boundary.size(), kPiece, [&](std::size_t begin, std::size_t end, std::vector<ThinPlace>& out) {
          for (std::size_t n = begin; n < end; ++n) {
            const ThinPlace place = edges.across(boundary[n], layers, thinnest_mm);
            if (place.layers < layers) out.push_back(place);
          }
        });
    check.vertices += boundary.size();
    check.broken += found.size();
    check.places.insert(check.places.end(), found.begin(), found.end());
  }
  std::stable_sort(check.places.begin(), check.places.end(),
                   [](const ThinPlace& a, const ThinPlace& b) { return a.layers < b.layers; });
  if (check.places.size() > kMostThinPlaces) check.places.resize(kMostThinPlaces);
  return check;
}

}  // namespace scantet
