#include "scantet/sizing/interface_gap.h"

#include <gtest/gtest.h>

#include <numbers>

#include "scantet/refine/mesher.h"
#include "unit/nested_balls.h"

namespace scantet {
namespace {

constexpr double kInner = 9;
constexpr double kOuter = 10;

TEST(InterfaceGaps, AreMeasuredBetweenBalls) {
  const test::NestedBalls balls(kInner, kOuter);
  Progress progress;
  const InterfaceGaps gaps = interface_gaps(balls, UniformSize(3), 1, progress);
  EXPECT_EQ(gaps.share, 1);
  EXPECT_NEAR(gaps.least_mm, 1, 1e-3);
  EXPECT_GE(gaps.median_mm, gaps.least_mm);
  EXPECT_LE(gaps.median_mm, 1.05);
}

TEST(InterfaceGaps, TellHowManyVerticesTheyTake) {
  const test::NestedBalls balls(kInner, kOuter);
  Progress progress;
  const UniformSize size(3);
  const double expected = interface_gaps(balls, size, 1, progress).expected_vertices;
  const MeshResult result = mesh_domain(balls, size, {}, progress);
  EXPECT_EQ(result.stop, Stop::converged);
  const auto vertices = static_cast<double>(result.mesh.vertices.size());
  EXPECT_GT(expected, 0.5 * vertices);
  EXPECT_LT(expected, 2 * vertices);
}

TEST(InterfaceGaps, ThoseThatFitTheSizeDoNotCount) {
  const test::NestedBalls balls(kInner, kOuter);
  Progress progress;
  EXPECT_EQ(interface_gaps(balls, UniformSize(3), 0.3, progress).share, 0);
  EXPECT_EQ(interface_gaps(balls, UniformSize(0.9), 1, progress).expected_vertices, 0);
}

TEST(InterfaceGaps, OneRegionHasNone) {
  Progress progress;
  EXPECT_EQ(interface_gaps(*make_sphere({}, kOuter), UniformSize(3), 1, progress).expected_vertices, 0);
}

}  // namespace
}  // namespace scantet
