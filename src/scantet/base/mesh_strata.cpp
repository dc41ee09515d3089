// Most meshes have no junctions: then a vertex on the boundary is on the one patch of its facets. Only facets at
// vertices with several patches are looked at edge by edge.
#include <algorithm>
#include <map>
#include <set>

#include "scantet/base/mesh_topology.h"

namespace scantet {
namespace {

using Edge = std::array<VertexId, 2>;

constexpr std::int32_t kNoPatch = -1;
constexpr std::int32_t kSeveral = -2;  // patches meet at the vertex

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

/// Curves and their edges; for each vertex of one the curves of its edges.
std::map<VertexId, std::vector<std::uint32_t>> set_curves(TetMesh& mesh, const std::vector<std::int32_t>& patch_of) {
  std::map<VertexId, std::vector<std::uint32_t>> curves_at;
  if (std::find(patch_of.begin(), patch_of.end(), kSeveral) == patch_of.end()) return curves_at;
  const auto edges = junction_edges(mesh, patch_of);
  std::map<std::set<Region>, std::uint32_t> numbers;
  for (const auto& [edge, regions] : edges) numbers.try_emplace(regions, 0);
  for (auto& [regions, number] : numbers) {
    number = static_cast<std::uint32_t>(mesh.curves.size());
    mesh.curves.push_back({{regions.begin(), regions.end()}, {}});
  }
  for (const auto& [edge, regions] : edges) {
    mesh.curve_edges.push_back(edge);
    mesh.edge_curves.push_back(numbers.at(regions));
    for (const VertexId v : edge) curves_at[v].push_back(numbers.at(regions));
  }
  return curves_at;
}

}  // namespace

void set_strata(TetMesh& mesh) {
  number_patches(mesh);
  mesh.curves.clear();
  mesh.curve_edges.clear();
  mesh.edge_curves.clear();
  mesh.corners.clear();
  mesh.strata.assign(mesh.vertices.size(), {});
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    for (const VertexId v : mesh.tets[i]) mesh.strata[v].index = mesh.tet_regions[i];
  }
  const std::vector<std::int32_t> patch_of = patches_of_vertices(mesh);
  const auto curves_at = set_curves(mesh, patch_of);
  for (VertexId v = 0; v < patch_of.size(); ++v) {
    if (patch_of[v] == kNoPatch) continue;
    if (patch_of[v] != kSeveral) {
      mesh.strata[v] = {patch_of[v], 2};
      continue;
    }
    const auto curves = curves_at.find(v);
    const bool passes =
        curves != curves_at.end() && curves->second.size() == 2 && curves->second.front() == curves->second.back();
    if (passes) {
      mesh.strata[v] = {static_cast<std::int32_t>(curves->second.front()), 1};
    } else {
      mesh.strata[v] = {static_cast<std::int32_t>(mesh.corners.size()), 0};
      mesh.corners.push_back(v);
    }
  }
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

}  // namespace scantet
