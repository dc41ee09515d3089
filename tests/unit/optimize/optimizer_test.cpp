#include "scantet/optimize/optimizer.h"

#include <gtest/gtest.h>

#include <limits>

#include "cancelled_after.h"
#include "scantet/base/error.h"
#include "scantet/check/audit.h"
#include "scantet/check/conformance.h"
#include "scantet/quality/quality.h"
#include "unit/cut_balls.h"
#include "unit/optimize/test_meshes.h"
#include "unit/sharp_cube.h"

namespace scantet {
namespace {

class Optimizer : public testing::Test {
 protected:
  OptimizerResult run(Optimize how, double min_dihedral_deg) {
    Progress progress;
    return optimize_mesh(mesh_, *domain_, {how, {.min_dihedral_deg = min_dihedral_deg}}, progress);
  }
  /// Tets that break the bound.
  std::uint64_t below(double min_dihedral_deg) const {
    return check_conformance(mesh_, *domain_, {.min_dihedral_deg = min_dihedral_deg}).min_dihedral.count;
  }
  void expect_result(const OptimizerResult& result, double min_dihedral_deg) const {
    const QualitySummary quality = measure_quality(mesh_);
    EXPECT_NEAR(result.min_dihedral_deg, quality.min_dihedral_deg(), 1e-6);
    EXPECT_EQ(below(min_dihedral_deg) == 0, quality.min_dihedral_deg() >= min_dihedral_deg * (1 - 1e-12));
  }

  std::unique_ptr<Domain> domain_ = make_torus({1, 2, 3}, 4, 1.5);
  TetMesh before_ = refined(*domain_, 0.4);
  TetMesh mesh_ = before_;
};

TEST_F(Optimizer, NoneMeasuresOnly) {
  const OptimizerResult result = run(Optimize::none, 10);
  EXPECT_TRUE(result.stages.empty());
  EXPECT_GT(below(10), 0U);
  EXPECT_EQ(mesh_.tets, before_.tets);
  expect_result(result, 10);
}

TEST_F(Optimizer, EdgesAreContractedLast) {
  Progress progress;
  OptimizerOptions options{Optimize::full, {.min_dihedral_deg = 10}};
  options.bounds.min_edge = EdgeTarget{0.3, 0, nullptr, true};
  const OptimizerResult result = optimize_mesh(mesh_, *domain_, options, progress);
  ASSERT_EQ(result.stages.size(), 2U);
  EXPECT_EQ(result.stages[0].stage, "improve");
  EXPECT_EQ(result.stages[1].stage, "contract");
  EXPECT_GT(result.stages[1].changes, 0U);
  EXPECT_LT(mesh_.vertices.size(), before_.vertices.size());
  EXPECT_EQ(below(10), 0U);
  expect_result(result, 10);
}

TEST_F(Optimizer, ExudeKeepsVerticesAndBoundary) {
  const OptimizerResult result = run(Optimize::exude, 10);
  ASSERT_EQ(result.stages.size(), 1U);
  EXPECT_EQ(result.stages[0].stage, "exude");
  EXPECT_GT(result.stages[0].changes, 0U);
  EXPECT_EQ(mesh_.vertices, before_.vertices);
  EXPECT_EQ(mesh_.boundary_facets, before_.boundary_facets);
  EXPECT_NE(mesh_.tets, before_.tets);
  expect_result(result, 10);
}

TEST_F(Optimizer, FullReachesTheTarget) {
  const double old_angle = measure_quality(mesh_).min_dihedral_deg();
  const OptimizerResult result = run(Optimize::full, 25);
  ASSERT_EQ(result.stages.size(), 1U);
  EXPECT_EQ(result.stages[0].stage, "improve");
  EXPECT_GT(result.stages[0].changes, 0U);
  EXPECT_GT(result.stages[0].seconds, 0);
  EXPECT_NEAR(result.stages[0].min_dihedral_before_deg, old_angle, 1e-6);
  EXPECT_EQ(result.stages[0].min_dihedral_after_deg, result.min_dihedral_deg);
  EXPECT_EQ(below(25), 0U);
  EXPECT_FALSE(result.cancelled);
  expect_result(result, 25);
}

TEST_F(Optimizer, HasNoStageWhereTheTargetIsMet) {
  run(Optimize::full, 20);
  const TetMesh improved = mesh_;
  const OptimizerResult again = run(Optimize::full, 20);
  EXPECT_TRUE(again.stages.empty());
  EXPECT_EQ(below(20), 0U);
  EXPECT_EQ(mesh_.tets, improved.tets);
}

TEST_F(Optimizer, GoesAsFarAsItCan) {
  mesh_ = refined(*domain_, 1);
  const OptimizerResult result = run(Optimize::full, 42);
  EXPECT_GT(below(42), 0U);
  EXPECT_GT(result.min_dihedral_deg, 20);
  expect_result(result, 42);
}

/// All that refinement was asked for, and what only improvement can reach.
ElementBounds all_bounds(const SizingField& size, double min_dihedral_deg) {
  return {min_dihedral_deg, 160, 0.1, RuleTarget{{}, &size}};
}

TEST_F(Optimizer, KeepsTheRulesThatRefinementMet) {
  const UniformSize size(0.4);
  for (const double angle_deg : {10.0, 20.0}) {
    mesh_ = before_;
    const ElementBounds bounds = all_bounds(size, angle_deg);
    ASSERT_FALSE(check_conformance(mesh_, *domain_, bounds).holds());
    Progress progress;
    optimize_mesh(mesh_, *domain_, {Optimize::full, bounds}, progress);
    const Conformance after = check_conformance(mesh_, *domain_, bounds);
    EXPECT_EQ(after.unmet.total(), 0U) << angle_deg;
    EXPECT_TRUE(after.holds()) << angle_deg;
  }
}

TEST_F(Optimizer, BreaksTheRulesWhereTheyAreNotAskedFor) {
  const UniformSize size(0.4);
  run(Optimize::full, 20);
  EXPECT_GT(check_conformance(mesh_, *domain_, all_bounds(size, 20)).unmet.r3, 0U)
      << "else the test above shows nothing";
}

TEST_F(Optimizer, ExudingKeepsTheRules) {
  const UniformSize size(0.4);
  const ElementBounds bounds = all_bounds(size, 20);
  run(Optimize::exude, 20);
  const std::uint64_t without = check_conformance(mesh_, *domain_, bounds).unmet.r3;
  ASSERT_GT(without, 10U) << "this shows nothing";
  mesh_ = before_;
  Progress progress;
  optimize_mesh(mesh_, *domain_, {Optimize::exude, bounds}, progress);
  EXPECT_LT(check_conformance(mesh_, *domain_, bounds).unmet.r3, without / 4) << "only in place of worse tets";
}

// A facet with a corner next to one of its edges: flipped, or its vertex moved away along the surface.
TEST_F(Optimizer, MendsFacetsThatBreakARule) {
  const UniformSize size(0.4);
  ElementBounds bounds = all_bounds(size, 10);
  bounds.max_dihedral_deg = 180;
  bounds.min_scaled_jacobian = 0;
  Progress progress;
  optimize_mesh(mesh_, *domain_, {Optimize::full, bounds}, progress);
  bounds.rules->bounds.facet_radius_edge = 0.8;  // no angle under 38.7°
  const Conformance before = check_conformance(mesh_, *domain_, bounds);
  ASSERT_GT(before.unmet.r1, 10U);
  ASSERT_EQ(before.unmet.r3, 0U);
  optimize_mesh(mesh_, *domain_, {Optimize::full, bounds}, progress);
  const Conformance after = check_conformance(mesh_, *domain_, bounds);
  EXPECT_LT(after.unmet.r1, before.unmet.r1 / 5);
  EXPECT_EQ(after.min_dihedral.count + after.unmet.r2 + after.unmet.r3, 0U)
      << "tets stay within their bounds meanwhile";
}

TEST_F(Optimizer, StopsWhenCancelled) {
  test::CancelledAfter progress(0);
  const OptimizerResult result = optimize_mesh(mesh_, *domain_, {Optimize::full, {.min_dihedral_deg = 20}}, progress);
  EXPECT_TRUE(result.cancelled);
  EXPECT_EQ(mesh_.tets, before_.tets);
  EXPECT_EQ(mesh_.boundary_facets, before_.boundary_facets);
  expect_result(result, 20);
}

TEST_F(Optimizer, RefusesTargetsOutOfRange) {
  for (const double target : {-1.0, 60.5, std::numeric_limits<double>::quiet_NaN()}) {
    try {
      run(Optimize::full, target);
      ADD_FAILURE() << target;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::usage);
      EXPECT_EQ(error.code(), "usage.option");
    }
  }
  for (const ElementBounds& bounds :
       {ElementBounds{.max_dihedral_deg = 89}, ElementBounds{.max_dihedral_deg = 181},
        ElementBounds{.min_scaled_jacobian = -0.1}, ElementBounds{.min_scaled_jacobian = 0.95},
        ElementBounds{.min_edge = EdgeTarget{-1, 0, nullptr, true}},
        ElementBounds{.min_edge = EdgeTarget{0, 0.6, nullptr, true}}}) {
    Progress progress;
    EXPECT_THROW(optimize_mesh(mesh_, *domain_, {Optimize::full, bounds}, progress), Error);
  }
  EXPECT_EQ(mesh_.tets, before_.tets);
}

TEST(OptimizerOfNothing, IsFine) {
  TetMesh mesh;
  Progress progress;
  const OptimizerResult result = optimize_mesh(mesh, *make_sphere({0, 0, 0}, 1), {}, progress);
  EXPECT_TRUE(result.stages.empty());
  EXPECT_TRUE(mesh.tets.empty());
}

/// Curves and corners stay where they are, and what lies between them keeps to them.
TEST(OptimizerOfCurves, ReachesTheTargetAndLeavesThemAlone) {
  const std::vector<std::shared_ptr<Domain>> domains{
      std::make_shared<test::CutBall>(10, 2), std::make_shared<test::CutBall>(10, 3),
      std::make_shared<test::CutBall>(10, 4), std::make_shared<test::SharpCube>(20)};
  for (const auto& domain : domains) {
    TetMesh mesh = refined(*domain, 1.5);
    const TetMesh before = mesh;
    Progress progress;
    const OptimizerResult result = optimize_mesh(mesh, *domain, {Optimize::full, {.min_dihedral_deg = 10}}, progress);
    EXPECT_GE(result.min_dihedral_deg, 10);
    EXPECT_EQ(mesh.corners.size(), before.corners.size());
    EXPECT_EQ(mesh.curve_edges.size(), before.curve_edges.size());
    AuditOptions options;
    options.restricted_delaunay = false;
    for (const Finding& finding : audit(mesh, domain.get(), options).findings) {
      ADD_FAILURE() << finding.code << ", " << finding.count << ": " << finding.message;
    }
  }
}

}  // namespace
}  // namespace scantet
