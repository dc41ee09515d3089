// What a finite element program finds in a file, read by means that share nothing with the writers, and its comparison
// with the mesh that was written.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "io_test_support.h"

namespace scantet {

/// Groups by name, with vertices counted from 0.
struct ReadModel {
  std::vector<Point> vertices;
  std::map<std::string, std::vector<Tet>> regions;
  std::map<std::string, std::vector<Triangle>> surfaces;
  std::map<std::string, std::set<VertexId>> node_sets;
};

/// A cube of n³ cells with so many regions, 1 … labels, in turn along the cells.
inline TetMesh make_labelled_cube(int n, int labels) {
  TetMesh mesh = make_cube(n);
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    mesh.tet_regions[i] = static_cast<Region>(i / 6 * static_cast<std::size_t>(labels) * 6 / mesh.tets.size()) + 1;
  }
  build_boundary(mesh);
  return mesh;
}

/// A mesh whose domain has names, some of which no format takes as they are.
inline TetMesh make_named_cube() {
  TetMesh mesh = make_cube(4, 1, 2);
  mesh.region_names = {{1, "Left kidney"}, {2, "left_Kidney"}};
  for (MeshPatch& patch : mesh.patches) {
    if (patch.regions == std::array<Region, 2>{1, 2}) patch.name = "wall <\"&> -- of it";
  }
  return mesh;
}

inline Triangle smallest_first(Triangle facet) {
  std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
  return facet;
}

inline double volume_of_tets(const std::vector<Point>& vertices, const std::vector<Tet>& tets) {
  double sum = 0;
  for (const Tet& t : tets) sum += orientation_mm3(vertices[t[0]], vertices[t[1]], vertices[t[2]], vertices[t[3]]) / 6;
  return sum;
}

/// The model that a file of this mesh must hold, under the names that stand in `names` instead of the mesh's own.
inline ReadModel model_of(const TetMesh& mesh, const std::map<std::string, std::string>& names = {}) {
  const auto named = [&](const std::string& name) { return names.contains(name) ? names.at(name) : name; };
  ReadModel model;
  model.vertices = mesh.vertices;
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    model.regions[named(region_name(mesh, mesh.tet_regions[i]))].push_back(mesh.tets[i]);
  }
  for (std::size_t i = 0; i < mesh.boundary_facets.size(); ++i) {
    const std::string name = named(patch_name(mesh.patches[mesh.facet_patches[i]]));
    model.surfaces[name].push_back(smallest_first(mesh.boundary_facets[i]));
  }
  return model;
}

/// Compares counts, coordinates (to `tolerance`, in mm), tets in their order, volumes, orientation, facets with their
/// sides, and names. Sets of nodes are the caller's to compare.
inline void expect_same_model(ReadModel read, const ReadModel& written, double tolerance) {
  ASSERT_EQ(read.vertices.size(), written.vertices.size());
  double largest = 0;
  for (std::size_t v = 0; v < read.vertices.size(); ++v) {
    largest = std::max(largest, std::sqrt(squared_length(read.vertices[v] - written.vertices[v])));
  }
  EXPECT_LE(largest, tolerance);
  ASSERT_EQ(read.regions.size(), written.regions.size());
  for (const auto& [name, tets] : written.regions) {
    ASSERT_TRUE(read.regions.contains(name)) << name;
    EXPECT_EQ(read.regions[name], tets) << name;
    EXPECT_NEAR(volume_of_tets(read.vertices, read.regions[name]), volume_of_tets(written.vertices, tets), 1e-6);
    for (const Tet& tet : read.regions[name]) ASSERT_GT(volume_of_tets(read.vertices, {tet}), 0) << name;
  }
  ASSERT_EQ(read.surfaces.size(), written.surfaces.size());
  for (auto [name, facets] : written.surfaces) {
    ASSERT_TRUE(read.surfaces.contains(name)) << name;
    std::vector<Triangle>& found = read.surfaces[name];
    for (Triangle& facet : found) facet = smallest_first(facet);
    std::sort(found.begin(), found.end());
    std::sort(facets.begin(), facets.end());
    EXPECT_EQ(found, facets) << name;
  }
}

/// How many sets of nodes curves and corners are, in formats that have them as such.
inline std::size_t sets_of_curves(const TetMesh& mesh) {
  return mesh.curves.size() + (mesh.corners.empty() ? 0 : 1);
}

/// The vertices of the boundary, and of a region of the model.
inline std::set<VertexId> vertices_of_surfaces(const ReadModel& model) {
  std::set<VertexId> found;
  for (const auto& [name, facets] : model.surfaces) {
    for (const Triangle& facet : facets) found.insert(facet.begin(), facet.end());
  }
  return found;
}
inline std::set<VertexId> vertices_of_region(const ReadModel& model, const std::string& name) {
  std::set<VertexId> found;
  for (const Tet& tet : model.regions.at(name)) found.insert(tet.begin(), tet.end());
  return found;
}

}  // namespace scantet
