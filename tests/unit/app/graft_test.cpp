#include "scantet/app/graft.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scantet/base/mesh_topology.h"
#include "scantet/base/tet_volume.h"
#include "scantet/check/audit.h"
#include "unit/quality/grid_mesh.h"

namespace scantet {
namespace {

constexpr int kCubes = 8;

VertexId vertex_at(const TetMesh& mesh, const Point& p) {
  const auto found = std::find(mesh.vertices.begin(), mesh.vertices.end(), p);
  return static_cast<VertexId>(found - mesh.vertices.begin());
}

/// The grid with some of its vertices moved.
TetMesh moved(TetMesh mesh, const std::vector<std::pair<Point, Point>>& moves) {
  for (const auto& [from, to] : moves) mesh.vertices[vertex_at(mesh, from)] = to;
  return mesh;
}

bool has(const TetMesh& mesh, const Point& p) {
  return vertex_at(mesh, p) < mesh.vertices.size();
}

double volume_of(const TetMesh& mesh) {
  double volume = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) volume += tet_volume_mm3(mesh, t);
  return volume;
}

TEST(Graft, WhatIsAwayFromTheSitesIsKept) {
  const Point here{2, 2, 2};
  const Point there{6, 6, 6};
  const TetMesh fresh = test::grid_mesh(kCubes);
  const TetMesh kept = moved(fresh, {{here, {2.3, 2.1, 2}}, {there, {6.1, 6, 6.2}}});
  const std::optional<TetMesh> mesh = graft(kept, fresh, {{here, 0.5}});
  ASSERT_TRUE(mesh);
  EXPECT_TRUE(has(*mesh, here)) << "as the fresh mesh has it";
  EXPECT_FALSE(has(*mesh, {2.3, 2.1, 2}));
  EXPECT_TRUE(has(*mesh, {6.1, 6, 6.2})) << "as the kept mesh has it";
  EXPECT_EQ(mesh->tets.size(), fresh.tets.size());
  EXPECT_EQ(mesh->vertices.size(), fresh.vertices.size());
  EXPECT_TRUE(audit(*mesh, nullptr, {}).passed());
  EXPECT_NEAR(volume_of(*mesh), kCubes * kCubes * kCubes, 1e-9);
}

TEST(Graft, NewVerticesAndOtherRegionsComeFromTheFreshMesh) {
  const TetMesh kept = test::grid_mesh(kCubes);
  TetMesh fresh = test::grid_mesh(kCubes, [](int i, int j, int k) { return i == 3 && j == 3 && k == 3 ? 2 : 1; });
  const Tet split = fresh.tets[test::tet_in_cube(kCubes, 3, 3, 3)];
  const auto middle = static_cast<VertexId>(fresh.vertices.size());
  Point center;
  for (const VertexId v : split) center = center + 0.25 * (fresh.vertices[v] - Point{});
  fresh.vertices.push_back(center);
  for (std::size_t k = 0; k < 4; ++k) {
    Tet part = split;
    part[k] = middle;
    if (k == 0) fresh.tets[test::tet_in_cube(kCubes, 3, 3, 3)] = part;
    if (k > 0) fresh.tets.push_back(part);
    if (k > 0) fresh.tet_regions.push_back(2);
  }
  fresh.region_names[2] = "core";
  build_boundary(fresh);
  const std::optional<TetMesh> mesh = graft(kept, fresh, {{center, 0.1}});
  ASSERT_TRUE(mesh);
  EXPECT_TRUE(has(*mesh, center));
  EXPECT_EQ(std::count(mesh->tet_regions.begin(), mesh->tet_regions.end(), 2), 9) << "the whole cube";
  EXPECT_EQ(mesh->region_names.at(2), "core");
  EXPECT_EQ(mesh->patches.size(), 2U);
  EXPECT_TRUE(audit(*mesh, nullptr, {}).passed());
}

TEST(Graft, TheBoundaryOfTheFreshMeshIsTakenAtASite) {
  const auto without_corner = [](int i, int j, int k) { return i + j + k == 0 ? kOutside : 1; };
  const TetMesh whole = test::grid_mesh(kCubes);
  const TetMesh cut = test::grid_mesh(kCubes, without_corner);
  for (const bool is_cut : {false, true}) {
    const std::optional<TetMesh> mesh = graft(is_cut ? whole : cut, is_cut ? cut : whole, {{{1, 1, 1}, 0.1}});
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->tets.size(), (is_cut ? cut : whole).tets.size());
    EXPECT_TRUE(audit(*mesh, nullptr, {}).passed());
  }
}

TEST(Graft, NothingComesOfItWhereMostWouldChange) {
  const TetMesh mesh = test::grid_mesh(kCubes);
  EXPECT_FALSE(graft(mesh, mesh, {}));
  EXPECT_FALSE(graft(mesh, mesh, {{{4, 4, 4}, kCubes}})) << "a site as wide as the mesh";
  TetMesh shifted = mesh;
  for (Point& p : shifted.vertices) p.x += 0.1;
  EXPECT_FALSE(graft(mesh, shifted, {{{4, 4, 4}, 0.5}})) << "no faces in common";
}

/// Two slabs, with a bridge of two cubes between them or without.
TetMesh slabs(bool has_bridge) {
  return test::grid_mesh(kCubes, [has_bridge](int i, int j, int k) {
    const bool is_between = i == 3 || i == 4;
    return !is_between || (has_bridge && j == 3 && k == 3) ? 1 : kOutside;
  });
}

TEST(Graft, WhatChangesTheTopologyStaysAsItIs) {
  const TetMesh kept = moved(slabs(false), {{{7, 7, 7}, {7.1, 7, 7}}});
  const std::vector<GraftSite> sites{{{4, 3.5, 3.5}, 1}, {{7, 7, 7}, 0.5}};
  const std::optional<TetMesh> mesh = graft(kept, slabs(true), sites, 0);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->tets.size(), kept.tets.size()) << "without the bridge";
  EXPECT_TRUE(has(*mesh, {7, 7, 7})) << "where that changes nothing it is taken";
  EXPECT_TRUE(audit(*mesh, nullptr, {}).passed());
}

TEST(Graft, WhatBringsTheTopologyThatIsMissingIsTaken) {
  const std::vector<GraftSite> sites{{{4, 3.5, 3.5}, 1}};
  const std::optional<TetMesh> joined = graft(slabs(false), slabs(true), sites, -1);
  ASSERT_TRUE(joined);
  EXPECT_EQ(joined->tets.size(), slabs(true).tets.size());
  EXPECT_EQ(audit(*joined, nullptr, {}).components.size(), 1U);
  const std::optional<TetMesh> parted = graft(slabs(true), slabs(false), sites, -1);
  ASSERT_TRUE(parted);
  EXPECT_EQ(parted->tets.size(), slabs(true).tets.size()) << "it would bring one too many";
}

}  // namespace
}  // namespace scantet
