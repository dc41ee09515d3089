#include "scantet/optimize/conformance.h"

#include <gtest/gtest.h>

#include "scantet/base/mesh_topology.h"
#include "scantet/base/parallel.h"
#include "scantet/domain/analytic.h"
#include "scantet/refine/mesher.h"

namespace scantet {
namespace {

/// A regular tet inscribed in the unit sphere: circumradius 1, radius-edge ratio √6/4 = 0.612; facets of circumradius
/// √8/3 = 0.943 and radius-edge ratio 0.577, whose surface balls are 2/3 away and have radius √(4/3) = 1.155.
class InscribedTet : public testing::Test {
 protected:
  InscribedTet() {
    const double s = 1 / std::sqrt(3.0);
    mesh_.vertices = {{s, s, s}, {-s, s, -s}, {s, -s, -s}, {-s, -s, s}};
    mesh_.tets = {{0, 1, 2, 3}};
    if (orientation_mm3(mesh_.vertices[0], mesh_.vertices[1], mesh_.vertices[2], mesh_.vertices[3]) < 0) {
      std::swap(mesh_.tets[0][2], mesh_.tets[0][3]);
    }
    mesh_.tet_regions = {1};
    build_boundary(mesh_);
  }

  RuleConformance check(double size_mm, const RuleBounds& bounds) const {
    return check_conformance(mesh_, *sphere_, UniformSize(size_mm), bounds);
  }

  std::unique_ptr<Domain> sphere_ = make_sphere({0, 0, 0}, 1);
  TetMesh mesh_;
};

using Conformance = InscribedTet;

TEST_F(Conformance, AllRulesHold) {
  EXPECT_EQ(check(1.2, {}), (RuleConformance{0, 0, 0, 4, 1}));
}

TEST_F(Conformance, BoundsThatAreMetExactlyAreMet) {
  const double facet_ratio = 1 / std::sqrt(3.0);
  EXPECT_EQ(check(1, {std::sqrt(4.0 / 3), facet_ratio, std::sqrt(6.0) / 4, 2.0 / 3}), (RuleConformance{0, 0, 0, 4, 1}));
}

TEST_F(Conformance, FacetShape) {
  EXPECT_EQ(check(1.2, {1, 0.57, 2, std::nullopt}), (RuleConformance{4, 0, 0, 4, 1}));
}

TEST_F(Conformance, VertexOffTheBoundary) {
  mesh_.on_boundary[2] = 0;
  EXPECT_EQ(check(1.2, {}), (RuleConformance{3, 0, 0, 4, 1}));
}

TEST_F(Conformance, BallTooLarge) {
  EXPECT_EQ(check(1.2, {0.9, 1, 2, std::nullopt}), (RuleConformance{0, 4, 0, 4, 1}));
}

TEST_F(Conformance, BallNowhereNear) {
  EXPECT_EQ(check(1.2, {0.5, 1, 2, std::nullopt}), (RuleConformance{0, 4, 0, 4, 1}));
}

TEST_F(Conformance, BallTooFarFromItsFacet) {
  EXPECT_EQ(check(1.2, {1, 1, 2, 0.67}), (RuleConformance{0, 0, 0, 4, 1}));
  EXPECT_EQ(check(1.2, {1, 1, 2, 0.66}), (RuleConformance{0, 4, 0, 4, 1}));
}

TEST_F(Conformance, TetTooLarge) {
  EXPECT_EQ(check(0.99, {2, 1, 2, std::nullopt}), (RuleConformance{0, 0, 1, 4, 1}));
}

TEST_F(Conformance, TetShape) {
  EXPECT_EQ(check(1.2, {1, 1, 0.61, std::nullopt}), (RuleConformance{0, 0, 1, 4, 1}));
}

TEST_F(Conformance, DegenerateElementsBreakEveryRule) {
  mesh_.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  EXPECT_EQ(check(1.2, {}), (RuleConformance{4, 4, 1, 4, 1}));
}

TEST_F(Conformance, EmptyMesh) {
  EXPECT_EQ(check_conformance({}, *sphere_, UniformSize(1), {}), RuleConformance{});
}

TEST(ConformanceOfAMesh, HoldsAfterRefinementAndFailsForStricterRules) {
  const auto sphere = make_sphere({1, 2, 3}, 5);
  const UniformSize size(1.2);
  Progress progress;
  const TetMesh mesh = mesh_domain(*sphere, size, {}, progress).mesh;
  const RuleConformance all{0, 0, 0, mesh.boundary_facets.size(), mesh.tets.size()};
  ASSERT_GT(all.facets, 300U);
  EXPECT_EQ(check_conformance(mesh, *sphere, size, {}), all);

  const RuleConformance strict = check_conformance(mesh, *sphere, UniformSize(0.8), {1, 0.7, 1, 0.01});
  EXPECT_GT(strict.r1, 0U);
  EXPECT_LT(strict.r1, all.facets);
  EXPECT_GT(strict.r2, all.facets / 2);
  EXPECT_GT(strict.r3, all.tets / 2);
  for (const std::size_t threads : {1, 2, 3}) {
    with_threads(threads, [&] {
      EXPECT_EQ(check_conformance(mesh, *sphere, UniformSize(0.8), {1, 0.7, 1, 0.01}), strict);
    });
  }
}

}  // namespace
}  // namespace scantet
