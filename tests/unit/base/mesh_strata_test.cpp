// What vertices lie on: fans of tets around an axis, one region each or in groups.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scantet/base/mesh_order.h"
#include "scantet/base/mesh_topology.h"

namespace scantet {
namespace {

/// Tets around the edge from vertex 0 to vertex 1, each between two of a ring of vertices from 2 on.
TetMesh fan(const std::vector<Region>& regions) {
  TetMesh mesh;
  mesh.vertices = {{0, 0, -1}, {0, 0, 1}};
  const auto count = static_cast<VertexId>(regions.size());
  for (VertexId i = 0; i < count; ++i) {
    const double angle = 2 * M_PI * i / count;
    mesh.vertices.push_back({std::cos(angle), std::sin(angle), 0});
  }
  for (VertexId i = 0; i < count; ++i) {
    mesh.tets.push_back({0, 2 + i, 2 + (i + 1) % count, 1});
    mesh.tet_regions.push_back(regions[i]);
  }
  build_boundary(mesh);
  return mesh;
}

TEST(MeshStrata, OneRegionHasOnePatchAndNoCurve) {
  const TetMesh mesh = fan({1, 1, 1, 1, 1, 1});
  ASSERT_EQ(mesh.patches.size(), 1U);
  EXPECT_EQ(mesh.patches[0].regions, (std::array<Region, 2>{1, 0}));
  EXPECT_TRUE(mesh.curves.empty() && mesh.curve_edges.empty() && mesh.corners.empty());
  for (VertexId v = 0; v < mesh.vertices.size(); ++v) EXPECT_EQ(mesh.strata[v], (Stratum{0, 2}));
  EXPECT_EQ(mesh.facet_patches, std::vector<std::uint32_t>(mesh.boundary_facets.size(), 0));
}

TEST(MeshStrata, AVertexInsideIsOnItsRegion) {
  TetMesh mesh = fan({1, 1, 1, 1});
  mesh.vertices.push_back({0.1, 0.1, 0});  // in the first tet
  mesh.tets[0] = {0, 2, 3, 6};
  mesh.tets.insert(mesh.tets.end(), {{6, 2, 3, 1}, {0, 6, 3, 1}, {0, 2, 6, 1}});
  mesh.tet_regions.assign(mesh.tets.size(), 7);
  build_boundary(mesh);
  EXPECT_EQ(mesh.strata[6], (Stratum{7, 3}));
  EXPECT_FALSE(mesh.on_boundary(6));
  EXPECT_TRUE(mesh.on_boundary(0));
}

TEST(MeshStrata, ThreeRegionsMeetInACurveWithCornersAtItsEnds) {
  const TetMesh mesh = fan({1, 1, 2, 2, 3, 3});
  EXPECT_EQ(mesh.patches.size(), 6U);  // three between them, three to the outside
  bool has_axis = false;
  for (std::size_t i = 0; i < mesh.curve_edges.size(); ++i) {
    if (mesh.curve_edges[i] != std::array<VertexId, 2>{0, 1}) continue;
    has_axis = true;
    EXPECT_EQ(mesh.curves[mesh.edge_curves[i]].regions, (std::vector<Region>{1, 2, 3}));
  }
  EXPECT_TRUE(has_axis);
  EXPECT_EQ(mesh.curves.size(), 4U);  // the axis, and three rims with the outside
  EXPECT_EQ(mesh.strata[0].dimension, 0);
  EXPECT_EQ(mesh.strata[1].dimension, 0);
  EXPECT_EQ(mesh.corners, (std::vector<VertexId>{0, 1}));
  EXPECT_EQ(mesh.strata[2].dimension, 1);  // where 3 and 1 meet, and the outside
  EXPECT_EQ(mesh.curves[static_cast<std::size_t>(mesh.strata[2].index)].regions, (std::vector<Region>{0, 1, 3}));
  EXPECT_EQ(mesh.strata[3].dimension, 2);  // in the middle of region 1
}

TEST(MeshStrata, PatchesKeepTheirNames) {
  TetMesh mesh = fan({1, 1, 2, 2});
  mesh.patches[1].name = "wall";
  const std::array<Region, 2> named = mesh.patches[1].regions;
  set_strata(mesh);
  for (const MeshPatch& patch : mesh.patches) EXPECT_EQ(patch.name, patch.regions == named ? "wall" : "");
  EXPECT_EQ(patch_name(mesh.patches[1]), "wall");
  EXPECT_EQ(patch_name(MeshPatch{{3, 0}, {}}), "boundary_3_0");
  mesh.region_names[2] = "liver";
  EXPECT_EQ(region_name(mesh, 2), "liver");
  EXPECT_EQ(region_name(mesh, 1), "region_1");
}

/// The same with a vertex before all others that no tet has.
TetMesh moved(TetMesh mesh) {
  const auto move = [](auto& elements) {
    for (auto& element : elements) {
      for (VertexId& v : element) ++v;
    }
  };
  mesh.vertices.insert(mesh.vertices.begin(), Point{});
  mesh.strata.insert(mesh.strata.begin(), Stratum{});
  move(mesh.tets);
  move(mesh.boundary_facets);
  move(mesh.curve_edges);
  return mesh;
}

TEST(FirstOrder, KeepsSharpCurvesAndPiecesOfPatches) {
  TetMesh mesh = fan({1, 1, 1, 1, 1, 1});
  mesh.curves = {{{0, 1}, "rim", true}};
  for (VertexId i = 0; i < 6; ++i) mesh.curve_edges.push_back({2 + i, 2 + (i + 1) % 6});
  mesh.edge_curves.assign(6, 0);
  set_strata(mesh);
  mesh.patches = {{{1, 0}, {}}, {{1, 0}, "lid"}};
  for (std::size_t f = 0; f < mesh.boundary_facets.size(); ++f) {
    const Triangle& facet = mesh.boundary_facets[f];
    mesh.facet_patches[f] = std::count(facet.begin(), facet.end(), 1) > 0 ? 1 : 0;
  }
  mesh.strata[1] = {1, 2};
  const TetMesh corners = first_order(moved(mesh));
  EXPECT_EQ(corners.vertices, mesh.vertices);
  EXPECT_EQ(corners.boundary_facets, mesh.boundary_facets);
  EXPECT_EQ(corners.strata, mesh.strata);
  EXPECT_EQ(corners.facet_patches, mesh.facet_patches);
  ASSERT_EQ(corners.patches.size(), 2U);
  EXPECT_EQ(corners.patches[1].name, "lid");
  EXPECT_EQ(corners.curve_edges, mesh.curve_edges);
  EXPECT_EQ(corners.edge_curves, mesh.edge_curves);
  ASSERT_EQ(corners.curves.size(), 1U);
  EXPECT_TRUE(corners.curves[0].is_sharp);
  EXPECT_EQ(corners.curves[0].name, "rim");
}

TEST(FirstOrder, CurvesWherePatchesMeetKeepTheirNames) {
  TetMesh mesh = fan({1, 1, 2, 2});
  ASSERT_EQ(mesh.curves.size(), 1U);
  mesh.curves[0].name = "seam";
  const TetMesh corners = first_order(moved(mesh));
  ASSERT_EQ(corners.curves.size(), 1U);
  EXPECT_EQ(corners.curves[0].name, "seam");
  EXPECT_EQ(corners.curve_edges, mesh.curve_edges);
  EXPECT_EQ(corners.patches.size(), mesh.patches.size());
}

}  // namespace
}  // namespace scantet
