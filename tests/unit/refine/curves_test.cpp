// Meshes of domains with curves: these are edges of the mesh, and what lies between them is as everywhere.
#include <gtest/gtest.h>

#include "scantet/check/audit.h"
#include "scantet/refine/mesher.h"
#include "unit/cut_balls.h"
#include "unit/sharp_cube.h"

namespace scantet {
namespace {

MeshResult meshed(const Domain& domain, double size_mm, std::size_t threads = 0) {
  Progress progress;
  MesherOptions options;
  options.threads = threads;
  return mesh_domain(domain, UniformSize(size_mm), options, progress);
}

void expect_sound(const Domain& domain, double size_mm) {
  const MeshResult result = meshed(domain, size_mm);
  EXPECT_EQ(result.stop, Stop::converged);
  EXPECT_EQ(result.counts.unmet.total(), 0U);
  EXPECT_TRUE(result.tangled.empty()) << result.tangled.size();
  AuditOptions options;
  options.restricted_delaunay = false;  // regions are those of orthocentres, which a mesh does not know
  for (const Finding& finding : audit(result.mesh, &domain, options).findings) {
    ADD_FAILURE() << finding.code << ", " << finding.count << ": " << finding.message << " at size " << size_mm;
  }
}

TEST(Curves, OfABallCutInTwoAreFollowed) {
  for (const double size_mm : {4.0, 2.0, 1.0}) expect_sound(test::CutBall(10, 2), size_mm);
}

TEST(Curves, OfThreeWedgesAreFollowed) {
  for (const double size_mm : {4.0, 2.0, 1.0}) expect_sound(test::CutBall(10, 3), size_mm);
}

TEST(Curves, OfFourCellsAreFollowed) {
  for (const double size_mm : {4.0, 2.0, 1.0}) expect_sound(test::CutBall(10, 4), size_mm);
}

TEST(Curves, OfACubeAreFollowed) {
  for (const double size_mm : {4.0, 2.0, 1.0}) expect_sound(test::SharpCube(20), size_mm);
}

TEST(Curves, OfACubeAreCurvesOfTheMesh) {
  const TetMesh mesh = meshed(test::SharpCube(20), 2).mesh;
  EXPECT_EQ(mesh.corners.size(), 8U);
  ASSERT_EQ(mesh.curves.size(), 12U);
  double length_mm = 0;
  for (const auto& edge : mesh.curve_edges) length_mm += distance(mesh.vertices[edge[0]], mesh.vertices[edge[1]]);
  EXPECT_NEAR(length_mm, 12 * 20, 1e-9);
  for (const MeshCurve& curve : mesh.curves) EXPECT_TRUE(curve.is_sharp);
}

TEST(Curves, StartAfreshInAFinerRound) {
  const test::CutBall domain(10, 4);
  const MeshResult coarse = meshed(domain, 3);
  Progress progress;
  const MeshResult fine = refine_further(domain, UniformSize(1.5), {}, coarse, progress);
  EXPECT_EQ(fine.counts.unmet.total(), 0U);
  AuditOptions options;
  options.restricted_delaunay = false;
  EXPECT_TRUE(audit(fine.mesh, &domain, options).passed());
}

TEST(Curves, GiveTheSameMeshForAnyNumberOfThreads) {
  const test::CutBall domain(10, 4);
  const MeshResult one = meshed(domain, 0.7, 1);
  const MeshResult two = meshed(domain, 0.7, 2);
  EXPECT_EQ(one.mesh.vertices, two.mesh.vertices);
  EXPECT_EQ(one.mesh.tets, two.mesh.tets);
}

}  // namespace
}  // namespace scantet
