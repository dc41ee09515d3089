#include "scantet/check/turned_hollows.h"

#include <algorithm>
#include <map>

#include "scantet/base/union_find.h"

namespace scantet {
namespace {

/// A closed surface between the mesh and the outside.
struct Surface {
  VertexId first = 0;  ///< of its vertices
  double volume = 0;   ///< six times what it encloses
};

/// The facets to the outside.
std::vector<std::uint32_t> outer_facets(const TetMesh& mesh) {
  std::vector<std::uint32_t> outer;
  for (std::uint32_t f = 0; f < mesh.boundary_facets.size(); ++f) {
    if (mesh.facet_regions[f][1] == kOutside) outer.push_back(f);
  }
  return outer;
}

/// Joins the vertices of a triangle or a tet.
template <class Element>
void unite_vertices(const Element& element, UnionFind& sets) {
  for (std::size_t i = 1; i < element.size(); ++i) sets.unite(element[0], element[i]);
}

}  // namespace

std::vector<std::uint32_t> turned_hollows(const TetMesh& mesh) {
  const std::vector<std::uint32_t> outer = outer_facets(mesh);
  const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
  UnionFind joined(count);
  for (const std::uint32_t f : outer) unite_vertices(mesh.boundary_facets[f], joined);
  std::map<std::uint32_t, Surface> surfaces;  // by the vertex that stands for each
  const auto surface_of = [&](std::uint32_t f) -> Surface& {
    const VertexId v = mesh.boundary_facets[f][0];
    return surfaces.try_emplace(joined.find(v), Surface{v}).first->second;
  };
  for (const std::uint32_t f : outer) {
    const auto& [a, b, c] = mesh.boundary_facets[f];
    Surface& surface = surface_of(f);
    surface.volume +=
        orientation_mm3(mesh.vertices[surface.first], mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
  }
  UnionFind bodies(count);
  for (const Tet& tet : mesh.tets) unite_vertices(tet, bodies);
  std::map<std::uint32_t, double> largest;  // of the surfaces of each body
  for (const auto& [v, surface] : surfaces) {
    double& volume = largest.try_emplace(bodies.find(v), surface.volume).first->second;
    volume = std::max(volume, surface.volume);
  }
  std::vector<std::uint32_t> turned;
  for (const std::uint32_t f : outer) {
    const Surface& surface = surface_of(f);
    if (surface.volume > 0 && surface.volume < largest.at(bodies.find(surface.first))) turned.push_back(f);
  }
  return turned;
}

}  // namespace scantet
