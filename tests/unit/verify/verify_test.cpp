// A mesh of one tet against a field that it fits, and the ways in which it does not.
#include "scantet/verify/verify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "block_mesh.h"
#include "found.h"
#include "scantet/base/error.h"
#include "scantet/base/parallel.h"
#include "scantet/field/scan_from_memory.h"

namespace scantet {
namespace {

using test::has;

/// A ball of radius 6 in 20³ voxels of 1 mm, its middle off the middle of the image.
Scan ball() {
  std::vector<float> values;
  for (int k = 0; k < 20; ++k) {
    for (int j = 0; j < 20; ++j) {
      for (int i = 0; i < 20; ++i) values.push_back(static_cast<float>(6 - std::hypot(i - 9.3, j - 9.6, k - 9.1)));
    }
  }
  return make_scan(std::move(values), {20, 20, 20}, Frame());
}

/// An octahedron, each facet split so often, with its vertices on a sphere, and all joined to the middle.
TetMesh cone_ball(int splits, double radius, const Point& middle) {
  std::vector<Point> points{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<Triangle> facets{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  const auto half = [&](VertexId a, VertexId b) {
    const Point sum = points[a] + points[b];
    const Point p = (1 / length(sum)) * sum;
    const auto at = std::find_if(points.begin(), points.end(), [&](const Point& q) { return distance(p, q) < 1e-9; });
    if (at == points.end()) points.push_back(p);
    return static_cast<VertexId>(
        std::find_if(points.begin(), points.end(), [&](const Point& q) { return distance(p, q) < 1e-9; }) -
        points.begin());
  };
  for (int n = 0; n < splits; ++n) {
    std::vector<Triangle> finer;
    for (const Triangle& t : facets) {
      const VertexId a = half(t[0], t[1]);
      const VertexId b = half(t[1], t[2]);
      const VertexId c = half(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], a, c}, {a, t[1], b}, {c, b, t[2]}, {a, b, c}});
    }
    facets = finer;
  }
  TetMesh mesh;
  for (const Point& p : points) mesh.vertices.push_back(middle + radius * p);
  mesh.vertices.push_back(middle);
  const auto last = static_cast<VertexId>(mesh.vertices.size() - 1);
  for (const Triangle& t : facets) mesh.tets.push_back({last, t[0], t[1], t[2]});
  mesh.tet_regions.assign(mesh.tets.size(), 1);
  return mesh;
}

Certificate verify_ball(const TetMesh& mesh, VerifyOptions options = {}) {
  if (!options.vertex_tolerance_mm) options.vertex_tolerance_mm = 0.2;  // the sphere is not the trilinear level set
  Progress progress;
  return verify_mesh(mesh, ball(), options, progress);
}

const Point kMiddle{9.3, 9.6, 9.1};

TEST(Verify, BallIsCertified) {
  const Certificate c = verify_ball(cone_ball(3, 6, kMiddle));
  EXPECT_EQ(c.grade, CertificateGrade::certified);
  EXPECT_TRUE(c.findings.empty());
  EXPECT_EQ(c.facets_certified, c.facets);
  EXPECT_EQ(c.field.components, 1);
  EXPECT_EQ(c.field.euler, 2);
  EXPECT_EQ(c.mesh.euler, 2);
  ASSERT_TRUE(c.mesh_to_level.upper_mm);
  EXPECT_GE(*c.mesh_to_level.upper_mm, c.mesh_to_level.lower_mm);
  EXPECT_LT(*c.mesh_to_level.upper_mm, 0.25);
  EXPECT_GT(c.mesh_to_level.lower_mm, 0.02);
}

// A block of the object runs out into voxels at the level. They count as outside, as nothing inside is beside most of
// them; but they may be inside, so the facets there are not proved to be far from the level set.
TEST(Verify, FacetsWithinVoxelsAtTheLevelAreNotFar) {
  const auto scan = [](float ties) {
    std::vector<float> values(std::size_t{14} * 8 * 8, -1);
    for (int k = 2; k <= 4; ++k) {
      for (int j = 2; j <= 4; ++j) {
        for (int i = 2; i <= 10; ++i) values[static_cast<std::size_t>((k * 8 + j) * 14 + i)] = i <= 4 ? 1 : ties;
      }
    }
    return make_scan(std::move(values), {14, 8, 8}, Frame());
  };
  TetMesh mesh;
  for (const double x : {7.5, 4.5, 1.5}) verify::add_block(mesh, {x, 1.5, 1.5}, 3, 2);
  for (Tet& tet : mesh.tets) {  // blocks share the vertices between them
    for (VertexId& v : tet) {
      v = static_cast<VertexId>(std::find(mesh.vertices.begin(), mesh.vertices.end(), mesh.vertices[v]) -
                                mesh.vertices.begin());
    }
  }
  Progress progress;
  const Certificate tied = verify_mesh(mesh, scan(0), {}, progress);
  EXPECT_TRUE(has(tied, "level.tie"));
  EXPECT_TRUE(has(tied, "facet.far"));
  EXPECT_EQ(tied.grade, CertificateGrade::undecided);
  EXPECT_EQ(verify_mesh(mesh, scan(-0.5F), {}, progress).grade, CertificateGrade::not_the_scan);
  VerifyOptions near;
  near.max_distance_mm = 1;
  EXPECT_EQ(verify_mesh(mesh, scan(0), near, progress).grade, CertificateGrade::undecided);
}

TEST(Verify, OutcomeDoesNotDependOnThreads) {
  const TetMesh mesh = cone_ball(2, 6, kMiddle);
  Certificate one;
  Certificate many;
  with_threads(1, [&] { one = verify_ball(mesh); });
  with_threads(4, [&] { many = verify_ball(mesh); });
  EXPECT_EQ(one.grade, many.grade);
  EXPECT_EQ(one.facets_certified, many.facets_certified);
  EXPECT_EQ(one.mesh_to_level.upper_mm, many.mesh_to_level.upper_mm);
  EXPECT_EQ(one.level_to_mesh.lower_mm, many.level_to_mesh.lower_mm);
}

TEST(Verify, WhatIsWrongIsNamed) {
  TetMesh turned = cone_ball(2, 6, kMiddle);
  std::swap(turned.tets[3][0], turned.tets[3][1]);
  EXPECT_TRUE(has(verify_ball(turned), "tet.not_positive"));
  TetMesh twice = cone_ball(2, 6, kMiddle);
  twice.tets.push_back(twice.tets[5]);
  twice.tet_regions.push_back(1);
  EXPECT_TRUE(has(verify_ball(twice), "face.shared") || has(verify_ball(twice), "face.same_side"));
  TetMesh regions = cone_ball(2, 6, kMiddle);
  regions.tet_regions[4] = 2;
  EXPECT_TRUE(has(verify_ball(regions), "mesh.regions"));
  const TetMesh inside = cone_ball(2, 2, kMiddle);
  TetMesh overlapping = cone_ball(2, 6, kMiddle);  // and a second ball within
  const auto base = static_cast<VertexId>(overlapping.vertices.size());
  overlapping.vertices.insert(overlapping.vertices.end(), inside.vertices.begin(), inside.vertices.end());
  for (const Tet& tet : inside.tets)
    overlapping.tets.push_back({tet[0] + base, tet[1] + base, tet[2] + base, tet[3] + base});
  overlapping.tet_regions.assign(overlapping.tets.size(), 1);
  EXPECT_TRUE(has(verify_ball(overlapping), "tets.overlap"));
  EXPECT_TRUE(has(verify_ball(overlapping), "topology.counts"));
  for (const TetMesh& mesh : {turned, twice, regions, overlapping}) {
    EXPECT_EQ(verify_ball(mesh).grade, CertificateGrade::not_the_scan);
  }
}

TEST(Verify, TetsThatCancelOutAreNoMesh) {
  TetMesh mesh = cone_ball(0, 6, kMiddle);
  mesh.tets = {mesh.tets[0], mesh.tets[0]};
  std::swap(mesh.tets[1][0], mesh.tets[1][1]);
  mesh.tet_regions = {1, 1};
  const Certificate c = verify_ball(mesh);
  EXPECT_EQ(c.grade, CertificateGrade::not_the_scan);
  EXPECT_TRUE(has(c, "boundary.none"));
}

TEST(Verify, MeshElsewhereIsNotCertified) {
  const Certificate far = verify_ball(cone_ball(2, 1, {2, 2, 2}));
  EXPECT_EQ(far.grade, CertificateGrade::not_the_scan);
  EXPECT_TRUE(has(far, "component.unmatched"));
  EXPECT_TRUE(has(far, "facet.far"));
  VerifyOptions strict;
  strict.vertex_tolerance_mm = 1e-3;
  EXPECT_EQ(verify_ball(cone_ball(3, 5.8, kMiddle), strict).grade, CertificateGrade::bounded);
  EXPECT_TRUE(has(verify_ball(cone_ball(3, 5.8, kMiddle), strict), "vertex.off_level"));
  VerifyOptions near;
  near.max_distance_mm = 0.1;
  EXPECT_EQ(verify_ball(cone_ball(3, 5.6, kMiddle), near).grade, CertificateGrade::not_the_scan);
  EXPECT_TRUE(has(verify_ball(cone_ball(3, 5.6, kMiddle), near), "distance.exceeded"));
}

TEST(Verify, InputThatCannotBeVerifiedIsRefused) {
  VerifyOptions options;
  options.level.level = 100;
  Progress progress;
  EXPECT_THROW(verify_mesh(cone_ball(1, 6, kMiddle), ball(), options, progress), Error);
  EXPECT_THROW(verify_mesh(TetMesh{}, ball(), {}, progress), Error);
  TetMesh torn = cone_ball(1, 6, kMiddle);
  torn.tets[0][2] = 1000000;
  EXPECT_THROW(verify_mesh(torn, ball(), {}, progress), Error);
  torn = cone_ball(1, 6, kMiddle);
  torn.tet_regions.pop_back();
  EXPECT_THROW(verify_mesh(torn, ball(), {}, progress), Error);
  TetMesh huge = cone_ball(1, 6, kMiddle);
  huge.vertices[0].x = 1e60;
  EXPECT_THROW(verify_mesh(huge, ball(), {}, progress), Error);
}

TEST(Verify, AMeshThatIsNoneIsAFaultOfTheProgramThatGivesIt) {
  TetMesh torn = cone_ball(1, 6, kMiddle);
  torn.tets[0][2] = 1000000;
  Progress progress;
  try {
    verify_mesh(torn, ball(), {}, progress);
    FAIL() << "no Error was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), "mesh.inconsistent");
    EXPECT_EQ(error.fault(), Fault::internal) << "as where it is measured or written";
  }
}

}  // namespace
}  // namespace scantet
