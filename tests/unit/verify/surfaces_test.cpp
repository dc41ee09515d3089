// Meshes of cubes, of cubes with cavities and of cubes that are elsewhere, against surfaces.
#include "scantet/verify/surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "block_mesh.h"
#include "error_code.h"
#include "found.h"
#include "scantet/base/parallel.h"
#include "scantet/verify/shell.h"

namespace scantet::verify {
namespace {

using test::has;

/// The surface of a cube; turned: as seen from within.
void add_cube(TriangleSurface& surface, const Point& least, double side, bool turned = false) {
  TetMesh block;
  add_block(block, least, side, 1);
  std::vector<VerifyFinding> none;
  const Shell shell = make_shell(block, none);
  const auto base = static_cast<VertexId>(surface.vertices.size());
  for (const VertexId v : shell.vertices) surface.vertices.push_back(block.vertices[v]);
  for (Triangle facet : shell.facets) {
    for (VertexId& v : facet) v += base;
    if (turned) std::swap(facet[0], facet[1]);
    surface.facets.push_back(facet);
  }
}

TriangleSurface cube(const Point& least, double side) {
  TriangleSurface surface;
  add_cube(surface, least, side);
  return surface;
}

Certificate verify(const TetMesh& mesh, const TriangleSurface& surface, const VerifyOptions& options = {}) {
  Progress progress;
  return verify_surface(mesh, surface, options, progress);
}

TetMesh block(const Point& least, double side, int n, const std::vector<std::array<int, 3>>& holes = {}) {
  TetMesh mesh;
  add_block(mesh, least, side, n, holes);
  return mesh;
}

TEST(VerifySurface, MeshOfTheSameCubeIsBoundedByNextToNothing) {
  const Certificate c = verify(block({1, 2, 3}, 4, 3), cube({1, 2, 3}, 4));
  EXPECT_EQ(c.grade, CertificateGrade::bounded);
  EXPECT_TRUE(c.findings.empty());
  EXPECT_TRUE(c.is_of_surface);
  EXPECT_EQ(c.field.components, 1);
  EXPECT_EQ(c.field.euler, 2);
  for (const VerifiedDistance* d : {&c.mesh_to_level, &c.level_to_mesh}) {
    ASSERT_TRUE(d->upper_mm);
    EXPECT_LT(*d->upper_mm, 0.02 * 4 / 3);
    EXPECT_LT(d->lower_mm, 1e-12);
  }
  EXPECT_LE(c.field_volume_mm3[0], 64);
  EXPECT_GE(c.field_volume_mm3[1], 64);
  EXPECT_NEAR(c.field_volume_mm3[0], 64, 1e-9);
}

TEST(VerifySurface, DistancesBothWaysAreBetweenTheirBounds) {
  // A smaller cube within: its facets are 0.5 from the larger cube; the larger one's corners sqrt(3)·0.5 from it.
  const Certificate c = verify(block({0.5, 0.5, 0.5}, 9, 9), cube({0, 0, 0}, 10));
  EXPECT_EQ(c.grade, CertificateGrade::bounded);
  EXPECT_NEAR(c.mesh_to_level.lower_mm, 0.5, 1e-12);
  EXPECT_GE(*c.mesh_to_level.upper_mm, 0.5);
  EXPECT_LT(*c.mesh_to_level.upper_mm, 0.55);
  const double corner = std::sqrt(0.75);
  EXPECT_NEAR(c.level_to_mesh.lower_mm, corner, 1e-12);
  EXPECT_GE(*c.level_to_mesh.upper_mm, corner);
  EXPECT_LT(*c.level_to_mesh.upper_mm, 1.1 * corner);
}

TEST(VerifySurface, CavitiesAndIslandsAreKnownHoweverTheyAreTurned) {
  for (const bool turned : {false, true}) {
    TriangleSurface surface = cube({0, 0, 0}, 9);
    add_cube(surface, {3, 3, 3}, 3, turned);
    const Certificate c = verify(block({0, 0, 0}, 9, 3, {{1, 1, 1}}), surface);
    EXPECT_EQ(c.grade, CertificateGrade::bounded);
    EXPECT_EQ(c.field.components, 1);
    EXPECT_EQ(c.field.cavities, 1);
    EXPECT_NEAR(c.field_volume_mm3[0], 702, 1e-6);
    add_cube(surface, {4, 4, 4}, 1, turned);
    TetMesh island = block({0, 0, 0}, 9, 3, {{1, 1, 1}});
    add_block(island, {4, 4, 4}, 1, 1);
    const Certificate with_island = verify(island, surface);
    EXPECT_EQ(with_island.grade, CertificateGrade::bounded);
    EXPECT_EQ(with_island.field.components, 2);
  }
}

TEST(VerifySurface, WhatTheMeshLacksOrHasTooMuchIsWrong) {
  TriangleSurface two = cube({0, 0, 0}, 4);
  add_cube(two, {6, 0, 0}, 4);
  const Certificate missing = verify(block({0, 0, 0}, 4, 2), two);
  EXPECT_EQ(missing.grade, CertificateGrade::not_the_scan);
  EXPECT_TRUE(has(missing, "topology.counts"));
  EXPECT_TRUE(has(missing, "surface.missing"));
  EXPECT_TRUE(has(missing, "surface.far"));
  const Certificate extra = verify(block({0, 0, 0}, 4, 4, {{1, 1, 1}}), cube({0, 0, 0}, 4));
  EXPECT_EQ(extra.grade, CertificateGrade::not_the_scan);
  EXPECT_TRUE(has(extra, "topology.counts"));
  EXPECT_TRUE(has(extra, "surface.extra"));
  const Certificate ring = verify(block({0, 0, 0}, 6, 3, {{1, 1, 0}, {1, 1, 1}, {1, 1, 2}}), cube({0, 0, 0}, 6));
  EXPECT_EQ(ring.grade, CertificateGrade::not_the_scan);
  EXPECT_TRUE(has(ring, "handles.differ"));
  // Where each is once, the cavity is not the component.
  TriangleSurface shell = cube({0, 0, 0}, 9);
  add_cube(shell, {3, 3, 3}, 3);
  TetMesh apart = block({0, 0, 0}, 9, 3);
  add_block(apart, {20, 0, 0}, 3, 1);
  EXPECT_EQ(verify(apart, shell).grade, CertificateGrade::not_the_scan);
}

TEST(VerifySurface, MeshElsewhereOrTooFarIsWrong) {
  const Certificate moved = verify(block({20, 0, 0}, 4, 2), cube({0, 0, 0}, 4));
  EXPECT_EQ(moved.grade, CertificateGrade::not_the_scan);
  EXPECT_TRUE(has(moved, "surface.far"));
  VerifyOptions options;
  options.max_distance_mm = 0.4;
  const Certificate wide = verify(block({0.5, 0.5, 0.5}, 9, 9), cube({0, 0, 0}, 10), options);
  EXPECT_EQ(wide.grade, CertificateGrade::not_the_scan);
  EXPECT_TRUE(has(wide, "distance.exceeded"));
  options.max_distance_mm = 0.87;
  const Certificate close = verify(block({0.5, 0.5, 0.5}, 9, 9), cube({0, 0, 0}, 10), options);
  EXPECT_NE(close.grade, CertificateGrade::not_the_scan);
}

TEST(VerifySurface, SurfaceThatIsNoneLeavesItUndecided) {
  TriangleSurface open = cube({0, 0, 0}, 4);
  open.facets.pop_back();
  const Certificate hole = verify(block({0, 0, 0}, 4, 2), open);
  EXPECT_EQ(hole.grade, CertificateGrade::undecided);
  EXPECT_TRUE(has(hole, "surface.edge"));
  TriangleSurface crossing = cube({0, 0, 0}, 4);
  add_cube(crossing, {2, 2, 2}, 4);
  const Certificate crossed = verify(block({0, 0, 0}, 4, 2), crossing);
  EXPECT_NE(crossed.grade, CertificateGrade::bounded);
  EXPECT_TRUE(has(crossed, "surface.crossing"));
}

TEST(VerifySurface, FacetsAreListedAndThreadsMakeNoDifference) {
  VerifyOptions options;
  options.lists_facets = true;
  const TetMesh mesh = block({0.5, 0.5, 0.5}, 9, 6);
  Certificate one;
  Certificate many;
  with_threads(1, [&] { one = verify(mesh, cube({0, 0, 0}, 10), options); });
  with_threads(4, [&] { many = verify(mesh, cube({0, 0, 0}, 10), options); });
  ASSERT_EQ(one.bounds.size(), one.facets);
  for (std::size_t f = 0; f < one.bounds.size(); ++f) {
    EXPECT_EQ(one.bounds[f].bound_mm, many.bounds[f].bound_mm);
    EXPECT_GE(one.bounds[f].bound_mm, 0.5);
  }
  EXPECT_EQ(one.level_to_mesh.upper_mm, many.level_to_mesh.upper_mm);
}

TEST(VerifySurface, WhatIsNoSurfaceIsRefused) {
  const TetMesh mesh = block({0, 0, 0}, 1, 1);
  EXPECT_EQ(test::error_code([&] { verify(mesh, {}); }), "input.surface");
  EXPECT_EQ(test::error_code([&] { verify(mesh, {{{0, 0, 0}}, {{0, 1, 2}}}); }), "input.surface");
  TriangleSurface huge = cube({0, 0, 0}, 1e60);
  EXPECT_EQ(test::error_code([&] { verify(mesh, huge); }), "input.range");
}

}  // namespace
}  // namespace scantet::verify
