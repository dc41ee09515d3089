// Most meshes have no junctions: then a vertex on the boundary is on the one patch of its facets. Only facets at
// vertices with several patches are looked at edge by edge.
#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "scantet/base/element_nodes.h"
#include "scantet/base/mesh_order.h"
#include "scantet/base/mesh_topology.h"

namespace scantet {
namespace {

using Edge = std::array<VertexId, 2>;

constexpr std::int32_t kNoPatch = -1;
constexpr std::int32_t kSeveral = -2;  // patches meet at the vertex
constexpr VertexId kUnused = std::numeric_limits<VertexId>::max();

void number_patches(TetMesh& mesh) {
  std::map<std::array<Region, 2>, std::string> names;
  for (const MeshPatch& patch : mesh.patches) names.try_emplace(patch.regions, patch.name);
  std::vector<std::array<Region, 2>> pairs;
  for (const auto& pair : mesh.facet_regions) {
    const auto place = std::lower_bound(pairs.begin(), pairs.end(), pair);
    if (place == pairs.end() || *place != pair) pairs.insert(place, pair);
  }
  mesh.patches.clear();
  for (const auto& pair : pairs) mesh.patches.push_back({pair, names[pair]});
  mesh.facet_patches.clear();
  mesh.facet_patches.reserve(mesh.facet_regions.size());
  for (const auto& pair : mesh.facet_regions) {
    const auto place = std::lower_bound(pairs.begin(), pairs.end(), pair);
    mesh.facet_patches.push_back(static_cast<std::uint32_t>(place - pairs.begin()));
  }
}

/// The patch of each vertex' facets.
std::vector<std::int32_t> patches_of_vertices(const TetMesh& mesh) {
  std::vector<std::int32_t> patch_of(mesh.vertices.size(), kNoPatch);
  for (std::size_t i = 0; i < mesh.boundary_facets.size(); ++i) {
    const auto patch = static_cast<std::int32_t>(mesh.facet_patches[i]);
    for (const VertexId v : mesh.boundary_facets[i]) {
      patch_of[v] = patch_of[v] == kNoPatch || patch_of[v] == patch ? patch : kSeveral;
    }
  }
  return patch_of;
}

/// The edges where facets of several patches meet, ascending, with the regions around each.
std::map<Edge, std::set<Region>> junction_edges(const TetMesh& mesh, const std::vector<std::int32_t>& patch_of) {
  std::map<Edge, std::set<std::uint32_t>> patches_at;
  for (std::size_t i = 0; i < mesh.boundary_facets.size(); ++i) {
    const Triangle& facet = mesh.boundary_facets[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(facet[k], facet[(k + 1) % 3]);
      if (patch_of[a] == kSeveral && patch_of[b] == kSeveral) patches_at[{a, b}].insert(mesh.facet_patches[i]);
    }
  }
  std::map<Edge, std::set<Region>> edges;
  for (const auto& [edge, patches] : patches_at) {
    if (patches.size() < 2) continue;
    for (const std::uint32_t patch : patches) {
      edges[edge].insert(mesh.patches[patch].regions.begin(), mesh.patches[patch].regions.end());
    }
  }
  return edges;
}

/// The curves of the edges of each vertex that has such edges.
using CurvesAt = std::map<VertexId, std::vector<std::uint32_t>>;

/// Adds an edge of the mesh's last curve.
void add_edge(TetMesh& mesh, const Edge& edge, std::uint32_t curve, CurvesAt& curves_at) {
  mesh.curve_edges.push_back(edge);
  mesh.edge_curves.push_back(curve);
  for (const VertexId v : edge) curves_at[v].push_back(curve);
}

/// Sets the curves where patches meet, and their edges.
void set_junctions(TetMesh& mesh, const std::vector<std::int32_t>& patch_of, CurvesAt& curves_at) {
  if (std::find(patch_of.begin(), patch_of.end(), kSeveral) == patch_of.end()) return;
  const auto edges = junction_edges(mesh, patch_of);
  std::map<std::set<Region>, std::uint32_t> numbers;
  for (const auto& [edge, regions] : edges) numbers.try_emplace(regions, 0);
  for (auto& [regions, number] : numbers) {
    number = static_cast<std::uint32_t>(mesh.curves.size());
    mesh.curves.push_back({{regions.begin(), regions.end()}, {}});
  }
  for (const auto& [edge, regions] : edges) add_edge(mesh, edge, numbers.at(regions), curves_at);
}

/// Adds the sharp curves that the mesh had.
void add_sharp_curves(const TetMesh& had, TetMesh& mesh, CurvesAt& curves_at) {
  std::map<std::uint32_t, std::uint32_t> number;
  for (std::size_t i = 0; i < had.curve_edges.size(); ++i) {
    const std::uint32_t curve = had.edge_curves[i];
    if (!had.curves[curve].is_sharp) continue;
    const auto [entry, is_new] = number.try_emplace(curve, static_cast<std::uint32_t>(mesh.curves.size()));
    if (is_new) mesh.curves.push_back(had.curves[curve]);
    add_edge(mesh, had.curve_edges[i], entry->second, curves_at);
  }
}

/// Strata of nodes on edges: of an edge of a curve that, of an edge of facets that of the first, else the region.
void set_edge_node_strata(TetMesh& mesh) {
  struct EdgeNode {
    Edge edge;
    VertexId node;
  };
  const auto is_before = [](const EdgeNode& a, const EdgeNode& b) { return a.edge < b.edge; };
  const auto ascending = [](VertexId a, VertexId b) { return a < b ? Edge{a, b} : Edge{b, a}; };
  std::vector<EdgeNode> nodes;  // of edges between vertices on the boundary
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t e = 0; e < 6; ++e) {
      const VertexId a = mesh.tets[t][kEdgesOfNodes[e][0]];
      const VertexId b = mesh.tets[t][kEdgesOfNodes[e][1]];
      const VertexId node = mesh.tet_edge_vertices[t][e];
      mesh.strata[node] = {mesh.tet_regions[t], 3};
      if (mesh.on_boundary(a) && mesh.on_boundary(b)) nodes.push_back({ascending(a, b), node});
    }
  }
  std::stable_sort(nodes.begin(), nodes.end(), is_before);
  const auto set = [&](VertexId a, VertexId b, Stratum stratum) {
    const auto found = std::lower_bound(nodes.begin(), nodes.end(), EdgeNode{ascending(a, b), 0}, is_before);
    if (found == nodes.end() || found->edge != ascending(a, b)) return;
    Stratum& of_node = mesh.strata[found->node];
    if (stratum.dimension < of_node.dimension) of_node = stratum;
  };
  for (std::size_t f = 0; f < mesh.boundary_facets.size(); ++f) {
    const Triangle& facet = mesh.boundary_facets[f];
    for (std::size_t i = 0; i < 3; ++i) {
      set(facet[i], facet[(i + 1) % 3], {static_cast<std::int32_t>(mesh.facet_patches[f]), 2});
    }
  }
  for (std::size_t i = 0; i < mesh.curve_edges.size(); ++i) {
    set(mesh.curve_edges[i][0], mesh.curve_edges[i][1], {static_cast<std::int32_t>(mesh.edge_curves[i]), 1});
  }
}

/// The curves of a mesh that tets do not tell of: the sharp ones, for set_strata() to keep.
void take_sharp_curves(const TetMesh& mesh, const std::vector<VertexId>& new_id, TetMesh& corners) {
  for (std::size_t i = 0; i < mesh.curve_edges.size(); ++i) {
    const auto [a, b] = mesh.curve_edges[i];
    if (!mesh.curves[mesh.edge_curves[i]].is_sharp || new_id[a] == kUnused || new_id[b] == kUnused) continue;
    corners.curve_edges.push_back({new_id[a], new_id[b]});
    corners.edge_curves.push_back(mesh.edge_curves[i]);
  }
  corners.curves = mesh.curves;
}

void take_curve_names(const TetMesh& mesh, TetMesh& corners) {
  for (MeshCurve& curve : corners.curves) {
    if (curve.is_sharp) continue;
    const auto alike = std::find_if(mesh.curves.begin(), mesh.curves.end(), [&](const MeshCurve& other) {
      return !other.is_sharp && other.regions == curve.regions;
    });
    if (alike != mesh.curves.end()) curve.name = alike->name;
  }
}

/// The patches of a mesh where some pair of regions has several, if they go with the facets of `corners`.
void take_pieces(const TetMesh& mesh, const std::vector<VertexId>& new_id, TetMesh& corners) {
  if (mesh.patches.size() <= corners.patches.size()) return;
  if (mesh.facet_patches.size() != mesh.boundary_facets.size()) return;
  const auto ascending = [](Triangle facet) {
    std::sort(facet.begin(), facet.end());
    return facet;
  };
  std::vector<std::pair<Triangle, std::uint32_t>> patch_of;
  for (std::size_t i = 0; i < mesh.boundary_facets.size(); ++i) {
    const auto [a, b, c] = mesh.boundary_facets[i];
    patch_of.emplace_back(ascending({new_id[a], new_id[b], new_id[c]}), mesh.facet_patches[i]);
  }
  std::sort(patch_of.begin(), patch_of.end());
  std::vector<std::uint32_t> patches;
  for (std::size_t i = 0; i < corners.boundary_facets.size(); ++i) {
    const Triangle facet = ascending(corners.boundary_facets[i]);
    const auto found = std::lower_bound(patch_of.begin(), patch_of.end(), std::pair{facet, std::uint32_t{0}});
    if (found == patch_of.end() || found->first != facet) return;
    if (mesh.patches[found->second].regions != corners.facet_regions[i]) return;
    patches.push_back(found->second);
  }
  corners.patches = mesh.patches;
  corners.facet_patches = std::move(patches);
  for (std::size_t i = 0; i < corners.boundary_facets.size(); ++i) {
    for (const VertexId v : corners.boundary_facets[i]) {
      Stratum& stratum = corners.strata[v];
      if (stratum.dimension == 2) stratum.index = static_cast<std::int32_t>(corners.facet_patches[i]);
    }
  }
}

}  // namespace

void set_strata(TetMesh& mesh) {
  number_patches(mesh);
  TetMesh had;  // its curves alone
  had.curves = std::exchange(mesh.curves, {});
  had.curve_edges = std::exchange(mesh.curve_edges, {});
  had.edge_curves = std::exchange(mesh.edge_curves, {});
  mesh.corners.clear();
  mesh.strata.assign(mesh.vertices.size(), {});
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    for (const VertexId v : mesh.tets[i]) mesh.strata[v].index = mesh.tet_regions[i];
  }
  const std::vector<std::int32_t> patch_of = patches_of_vertices(mesh);
  CurvesAt curves_at;
  set_junctions(mesh, patch_of, curves_at);
  add_sharp_curves(had, mesh, curves_at);
  for (VertexId v = 0; v < patch_of.size(); ++v) {
    if (patch_of[v] == kNoPatch) continue;
    const auto curves = curves_at.find(v);
    if (patch_of[v] != kSeveral && curves == curves_at.end()) {
      mesh.strata[v] = {patch_of[v], 2};
      continue;
    }
    const bool passes =
        curves != curves_at.end() && curves->second.size() == 2 && curves->second.front() == curves->second.back();
    if (passes) {
      mesh.strata[v] = {static_cast<std::int32_t>(curves->second.front()), 1};
    } else {
      mesh.strata[v] = {static_cast<std::int32_t>(mesh.corners.size()), 0};
      mesh.corners.push_back(v);
    }
  }
  if (!mesh.tet_edge_vertices.empty()) set_edge_node_strata(mesh);
}

TetMesh first_order(const TetMesh& mesh) {
  std::vector<VertexId> new_id(mesh.vertices.size(), kUnused);
  for (const Tet& tet : mesh.tets) {
    for (const VertexId v : tet) new_id[v] = 0;
  }
  TetMesh corners;
  for (std::size_t v = 0; v < new_id.size(); ++v) {
    if (new_id[v] == kUnused) continue;
    new_id[v] = static_cast<VertexId>(corners.vertices.size());
    corners.vertices.push_back(mesh.vertices[v]);
  }
  for (const Tet& tet : mesh.tets) {
    corners.tets.push_back({new_id[tet[0]], new_id[tet[1]], new_id[tet[2]], new_id[tet[3]]});
  }
  corners.tet_regions = mesh.tet_regions;
  corners.region_names = mesh.region_names;
  corners.patches = mesh.patches;
  take_sharp_curves(mesh, new_id, corners);
  build_boundary(corners);
  take_curve_names(mesh, corners);
  take_pieces(mesh, new_id, corners);
  return corners;
}

std::string region_name(const TetMesh& mesh, Region region) {
  const auto named = mesh.region_names.find(region);
  const bool has_name = named != mesh.region_names.end() && !named->second.empty();
  return has_name ? named->second : "region_" + std::to_string(region);
}

std::string patch_name(const MeshPatch& patch) {
  if (!patch.name.empty()) return patch.name;
  return "boundary_" + std::to_string(patch.regions[0]) + "_" + std::to_string(patch.regions[1]);
}

std::string curve_name(const MeshCurve& curve) {
  if (!curve.name.empty()) return curve.name;
  std::string name = "curve";
  for (const Region region : curve.regions) name += "_" + std::to_string(region);
  return name;
}

}  // namespace scantet
