#include "scantet/check/losses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "scantet/domain/analytic.h"
#include "unit/quality/grid_mesh.h"
#include "unit/sharp_cube.h"

namespace scantet {
namespace {

const UniformSize kSizing(4);

TEST(CountLosses, NothingIsLostOfTheBall) {
  EXPECT_EQ(count_losses(test::ball_mesh(6, {}, 10), *make_sphere({}, 10), kSizing).count, 0U);
}

TEST(CountLosses, ABallOfTwoIsLost) {
  EXPECT_GT(count_losses(test::ball_mesh(6, {12, 0, 0}, 10), *make_two_spheres(10, 4), kSizing).count, 0U);
}

TEST(CountLosses, ARingsHandleIsLost) {
  const LossCount losses = count_losses(test::ball_mesh(6, {}, 10), *make_torus({}, 7, 3), kSizing);
  EXPECT_EQ(losses.count, 1U);
  EXPECT_EQ(losses.missing_euler, -2);
  EXPECT_TRUE(losses.small_parts.empty()) << "it may be anywhere";
  EXPECT_TRUE(losses.in_small_parts.empty());
  const LossCount small = count_losses(test::ball_mesh(6, {}, 10), *make_torus({}, 7, 3), UniformSize(20));
  EXPECT_EQ(small.small_parts.size(), 1U);
  EXPECT_EQ(small.in_small_parts.size(), 8U) << "of a box of 20 mm, at most 10 mm apart";
  for (const Point& p : small.in_small_parts) EXPECT_EQ(std::abs(p.x), 5);
}

TEST(CountLosses, APinchCounts) {
  const TetMesh mesh = test::grid_mesh(4, [](int i, int j, int k) {
    const bool is_low = i < 2 && j < 2 && k < 2;
    const bool is_high = i > 1 && j > 1 && k > 1;
    return is_low || is_high ? 1 : kOutside;
  });
  const auto ball = make_sphere({2, 2, 2}, 2);
  EXPECT_GE(count_losses(mesh, *ball, kSizing).count, 1U);
}

TEST(CountLosses, WhereNothingFollowsACurveThereIsAGap) {
  EXPECT_FALSE(count_losses(test::ball_mesh(6, {}, 10), test::SharpCube(10), kSizing).curve_gaps.empty());
  EXPECT_TRUE(count_losses(test::ball_mesh(6, {}, 10), *make_sphere({}, 10), kSizing).curve_gaps.empty());
}

TEST(CountLosses, AMeshThatIsNotWholeHasNone) {
  TetMesh mesh = test::ball_mesh(4, {}, 10);
  mesh.tet_regions.pop_back();
  EXPECT_EQ(count_losses(mesh, *make_sphere({}, 10), kSizing).count, 0U);
}

}  // namespace
}  // namespace scantet
