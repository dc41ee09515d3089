// Balls along a stretch of a curve: as large as there is room for, at even steps.
#include <gtest/gtest.h>

#include "scantet/sampling/curve_stretch_impl.h"

namespace scantet {
namespace {

TEST(CurveStretch, BetweenOthersBeginsWithABallAndLeavesRoomForTheNext) {
  const std::vector<CurveRoom> rooms{{0, 1}, {10, 1}};
  const std::vector<CurveBall> balls = cover_stretch(rooms, {2, 8});
  ASSERT_EQ(balls.size(), 4U);
  for (std::size_t k = 0; k < balls.size(); ++k) {
    EXPECT_NEAR(balls[k].along_mm, 2 + 1.5 * static_cast<double>(k), 1e-12);
    EXPECT_NEAR(balls[k].radius_mm, 1, 1e-12);
  }
}

TEST(CurveStretch, BetweenCornersIsFilledEvenly) {
  const std::vector<CurveRoom> rooms{{0, 1}, {10, 1}};
  const std::vector<CurveBall> balls = cover_stretch(rooms, {1, 9, true, true});
  ASSERT_EQ(balls.size(), 6U);
  EXPECT_LE(balls[0].radius_mm, 1);
  EXPECT_NEAR(balls.front().along_mm - 1, 0.5 * balls.front().radius_mm, 1e-12);
  EXPECT_NEAR(9 - balls.back().along_mm, 0.5 * balls.back().radius_mm, 1e-12);
}

TEST(CurveStretch, FollowsTheRoomThereIs) {
  const std::vector<CurveRoom> rooms{{0, 0.2}, {4, 1.2}, {20, 1.2}};
  const std::vector<CurveBall> balls = cover_stretch(rooms, {0, 20});
  for (const CurveBall& ball : balls) EXPECT_LE(ball.radius_mm, std::min(1.2, 0.2 + ball.along_mm / 4) + 1e-12);
  EXPECT_LT(balls[0].radius_mm, 0.21);
  EXPECT_GT(balls.back().radius_mm, 1.1);
}

TEST(CurveStretch, HasAsManyAsAskedFor) {
  const std::vector<CurveRoom> rooms{{0, 1}, {1, 1}};
  EXPECT_EQ(cover_stretch(rooms, {0, 1}).size(), 1U);
  EXPECT_EQ(cover_stretch(rooms, {0, 1, false, false, 5}).size(), 5U);
}

}  // namespace
}  // namespace scantet
