#include "scantet/base/box_clip.h"

#include <gtest/gtest.h>

#include <random>

namespace scantet {
namespace {

const Box kBox{{-1, -2, -3}, {4, 5, 6}};

TEST(ClipToBox, ASegmentWithinIsAllOfIt) {
  const auto stretch = clip_to_box({0, 0, 0}, {1, 1, -1}, kBox);
  ASSERT_TRUE(stretch);
  EXPECT_EQ(stretch->enter, 0);
  EXPECT_EQ(stretch->leave, 1);
  EXPECT_EQ(stretch->enter_axis, -1);
  EXPECT_EQ(stretch->leave_axis, -1);
}

TEST(ClipToBox, SaysThroughWhichWallsItGoes) {
  const auto stretch = clip_to_box({-2, 0, 0}, {4, 10, 0}, kBox);
  ASSERT_TRUE(stretch);
  EXPECT_EQ(stretch->enter, 0.25);
  EXPECT_EQ(stretch->enter_axis, 0);
  EXPECT_EQ(stretch->leave, 0.5);
  EXPECT_EQ(stretch->leave_axis, 1);
}

TEST(ClipToBox, WallsBelongToTheBox) {
  EXPECT_TRUE(clip_to_box({-1, 0, 0}, {0, 1, 0}, kBox));
  EXPECT_TRUE(clip_to_box({4, 5, 6}, {1, 1, 1}, kBox));
  EXPECT_TRUE(clip_to_box({4, 5, 6}, {0, 0, 0}, kBox));
  EXPECT_FALSE(clip_to_box({-1.5, 0, 0}, {0, 1, 0}, kBox));
}

TEST(ClipToBox, NothingIsLeftOfASegmentBeside) {
  EXPECT_FALSE(clip_to_box({-5, 0, 0}, {3, 0, 0}, kBox));
  EXPECT_FALSE(clip_to_box({-2, 4.5, 0}, {2, 2, 0}, kBox));
  EXPECT_FALSE(clip_to_box({0, std::numeric_limits<double>::quiet_NaN(), 0}, {1, 0, 0}, kBox));
}

TEST(Clipped, KeepsEndsWithinAndPutsTheOthersOnWalls) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-12, 12);
  const auto at_random = [&] { return Point{place(random), place(random), place(random)}; };
  const Box wider{kBox.min - Vec{1e-12, 1e-12, 1e-12}, kBox.max + Vec{1e-12, 1e-12, 1e-12}};
  int left = 0;
  for (int n = 0; n < 2000; ++n) {
    const Segment whole{at_random(), at_random()};
    const auto part = clipped(whole, kBox);
    for (int i = 0; i <= 50; ++i) {
      const Point p = lerp(whole.source, whole.target, i / 50.0);
      if (!kBox.contains(p)) continue;
      ASSERT_TRUE(part);
      EXPECT_LE(distance(part->source, p) + distance(p, part->target), distance(part->source, part->target) + 1e-9);
    }
    if (!part) continue;
    ++left;
    EXPECT_EQ(kBox.contains(whole.source), part->source == whole.source);
    EXPECT_EQ(kBox.contains(whole.target), part->target == whole.target);
    EXPECT_TRUE(wider.contains(part->source) && wider.contains(part->target));
  }
  EXPECT_GT(left, 200);
}

}  // namespace
}  // namespace scantet
