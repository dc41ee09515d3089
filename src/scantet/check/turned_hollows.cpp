#include "scantet/check/turned_hollows.h"

#include <algorithm>
#include <map>

#include "scantet/base/union_find.h"

namespace scantet {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;

/// A closed surface between the mesh and the outside.
struct Surface {
  Point origin;  // a vertex of it
  double volume = 0;
};

bool is_outer(const TetMesh& mesh, std::size_t facet) {
  return mesh.facet_regions[facet][1] == kOutside;
}

/// The sets of vertices that hang together by facets to the outside; surface_of: of each vertex, kNone beside them.
std::vector<Surface> surfaces_of(const TetMesh& mesh, std::vector<std::uint32_t>& surface_of) {
  UnionFind joined(static_cast<std::uint32_t>(mesh.vertices.size()));
  for (std::size_t f = 0; f < mesh.boundary_facets.size(); ++f) {
    const Triangle& facet = mesh.boundary_facets[f];
    if (!is_outer(mesh, f)) continue;
    joined.unite(facet[0], facet[1]);
    joined.unite(facet[0], facet[2]);
  }
  std::vector<Surface> surfaces;
  surface_of.assign(mesh.vertices.size(), kNone);
  std::vector<std::uint32_t> number(mesh.vertices.size(), kNone);
  for (std::size_t f = 0; f < mesh.boundary_facets.size(); ++f) {
    const Triangle& facet = mesh.boundary_facets[f];
    if (!is_outer(mesh, f)) continue;
    std::uint32_t& n = number[joined.find(facet[0])];
    if (n == kNone) {
      n = static_cast<std::uint32_t>(surfaces.size());
      surfaces.push_back({mesh.vertices[facet[0]]});
    }
    for (const VertexId v : facet) surface_of[v] = n;
    const Point& o = surfaces[n].origin;
    surfaces[n].volume +=
        dot(cross(mesh.vertices[facet[0]] - o, mesh.vertices[facet[1]] - o), mesh.vertices[facet[2]] - o);
  }
  return surfaces;
}

}  // namespace

std::vector<std::uint32_t> turned_hollows(const TetMesh& mesh) {
  std::vector<std::uint32_t> surface_of;
  const std::vector<Surface> surfaces = surfaces_of(mesh, surface_of);
  UnionFind bodies(static_cast<std::uint32_t>(mesh.vertices.size()));
  for (const Tet& tet : mesh.tets) {
    for (std::size_t i = 1; i < 4; ++i) bodies.unite(tet[0], tet[i]);
  }
  std::vector<std::uint32_t> body_of(surfaces.size());
  std::map<std::uint32_t, double> largest;  // of the surfaces of each body
  for (VertexId v = 0; v < mesh.vertices.size(); ++v) {
    const std::uint32_t n = surface_of[v];
    if (n == kNone) continue;
    body_of[n] = bodies.find(v);
    double& volume = largest.try_emplace(body_of[n], surfaces[n].volume).first->second;
    volume = std::max(volume, surfaces[n].volume);
  }
  std::vector<std::uint32_t> turned;
  for (std::uint32_t f = 0; f < mesh.boundary_facets.size(); ++f) {
    if (!is_outer(mesh, f)) continue;
    const std::uint32_t n = surface_of[mesh.boundary_facets[f][0]];
    if (surfaces[n].volume > 0 && surfaces[n].volume < largest.at(body_of[n])) turned.push_back(f);
  }
  return turned;
}

}  // namespace scantet
