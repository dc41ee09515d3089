#include "scantet/optimize/optimizer.h"

#include <gtest/gtest.h>

#include <limits>

#include "cancelled_after.h"
#include "scantet/base/error.h"
#include "scantet/quality/quality.h"
#include "unit/optimize/test_meshes.h"

namespace scantet {
namespace {

class Optimizer : public testing::Test {
 protected:
  OptimizerResult run(Optimize how, double min_dihedral_deg) {
    Progress progress;
    return optimize_mesh(mesh_, *domain_, {how, min_dihedral_deg}, progress);
  }
  void expect_result(const OptimizerResult& result, double min_dihedral_deg) const {
    const QualitySummary quality = measure_quality(mesh_);
    EXPECT_NEAR(result.min_dihedral_deg, quality.min_dihedral_deg(), 1e-6);
    EXPECT_EQ(result.tets_below == 0, quality.min_dihedral_deg() >= min_dihedral_deg * (1 - 1e-12));
  }

  std::unique_ptr<Domain> domain_ = make_torus({1, 2, 3}, 4, 1.5);
  TetMesh before_ = refined(*domain_, 0.4);
  TetMesh mesh_ = before_;
};

TEST_F(Optimizer, NoneMeasuresOnly) {
  const OptimizerResult result = run(Optimize::none, 10);
  EXPECT_TRUE(result.stages.empty());
  EXPECT_GT(result.tets_below, 0U);
  EXPECT_EQ(mesh_.tets, before_.tets);
  expect_result(result, 10);
}

TEST_F(Optimizer, ExudeKeepsVerticesAndBoundary) {
  const OptimizerResult result = run(Optimize::exude, 10);
  ASSERT_EQ(result.stages.size(), 1U);
  EXPECT_STREQ(result.stages[0].stage, "exude");
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
  EXPECT_STREQ(result.stages[0].stage, "improve");
  EXPECT_GT(result.stages[0].changes, 0U);
  EXPECT_GT(result.stages[0].seconds, 0);
  EXPECT_NEAR(result.stages[0].min_dihedral_before_deg, old_angle, 1e-6);
  EXPECT_EQ(result.stages[0].min_dihedral_after_deg, result.min_dihedral_deg);
  EXPECT_EQ(result.tets_below, 0U);
  EXPECT_FALSE(result.cancelled);
  expect_result(result, 25);
}

TEST_F(Optimizer, HasNoStageWhereTheTargetIsMet) {
  run(Optimize::full, 20);
  const TetMesh improved = mesh_;
  const OptimizerResult again = run(Optimize::full, 20);
  EXPECT_TRUE(again.stages.empty());
  EXPECT_EQ(again.tets_below, 0U);
  EXPECT_EQ(mesh_.tets, improved.tets);
}

TEST_F(Optimizer, GoesAsFarAsItCan) {
  mesh_ = refined(*domain_, 1);
  const OptimizerResult result = run(Optimize::full, 42);
  EXPECT_GT(result.tets_below, 0U);
  EXPECT_GT(result.min_dihedral_deg, 20);
  expect_result(result, 42);
}

TEST_F(Optimizer, StopsWhenCancelled) {
  test::CancelledAfter progress(0);
  const OptimizerResult result = optimize_mesh(mesh_, *domain_, {Optimize::full, 20}, progress);
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
  EXPECT_EQ(mesh_.tets, before_.tets);
}

TEST(OptimizerOfNothing, IsFine) {
  TetMesh mesh;
  Progress progress;
  const OptimizerResult result = optimize_mesh(mesh, *make_sphere({0, 0, 0}, 1), {}, progress);
  EXPECT_EQ(result.tets_below, 0U);
  EXPECT_TRUE(mesh.tets.empty());
}

}  // namespace
}  // namespace scantet
