#include "scantet/topology/wall_overlap.h"

#include <gtest/gtest.h>

namespace scantet {
namespace {

// Open pieces count 1, and each stretch of the square's edge that they reach takes 1 away.
TEST(WallOverlap, OfOneFunctionAlone) {
  EXPECT_EQ(euler_of_overlap({1, 1, 1, 1}, {1, 1, 1, 1}), 1) << "the open square";
  EXPECT_EQ(euler_of_overlap({1, 1, 1, 1}, {-1, -1, -1, -1}), 0) << "nothing";
  EXPECT_EQ(euler_of_overlap({1, 1, 1, 1}, {2, -1, -1, -1}), 0) << "a corner";
  EXPECT_EQ(euler_of_overlap({1, 1, 1, 1}, {1, 1, -1, -1}), 0) << "a half";
  EXPECT_EQ(euler_of_overlap({1, 1, 1, 1}, {2, -1, 2, -1}), -1) << "a strip from corner to corner";
  EXPECT_EQ(euler_of_overlap({1, 1, 1, 1}, {1, -2, 1, -2}), 0) << "two corners";
  EXPECT_EQ(euler_of_overlap({1, 1, 1, 1}, {1, -1, 1, -1}), 0) << "two corners that touch";
  EXPECT_EQ(euler_of_overlap({0, 0, 1, 0}, {1, 1, 1, 1}), 1) << "what is zero on the square's edge is open";
}

TEST(WallOverlap, OfTwoFunctions) {
  EXPECT_EQ(euler_of_overlap({1, 1, -2, -2}, {-2, -2, 1, 1}), 0) << "thin halves that do not meet";
  EXPECT_EQ(euler_of_overlap({2, 2, -1, -1}, {-1, -1, 2, 2}), -1) << "a strip from side to side";
  EXPECT_EQ(euler_of_overlap({1, 1, -1, -1}, {-1, -1, 1, 1}), 0) << "halves that touch";
  EXPECT_EQ(euler_of_overlap({1, -1, -1, 1}, {1, 1, -1, -1}), 0) << "a corner";
  EXPECT_EQ(euler_of_overlap({3, -1, 3, -1}, {-1, 3, -1, 3}), -3) << "strips that cross: a cross";
}

TEST(WallOverlap, IsThereOrNot) {
  const auto do_parts_overlap = [](const WallHeights& a, int corner, const WallHeights& b, int other) {
    return do_overlap(WallPart{a, corner, false}, WallPart{b, other, true});
  };
  EXPECT_TRUE(do_parts_overlap({1, 1, 1, 1}, 0, {2, -1, -1, -1}, 0)) << "a corner, whose Euler number is 0";
  EXPECT_TRUE(do_parts_overlap({2, 2, -1, -1}, 0, {-1, -1, 2, 2}, 2)) << "a strip";
  EXPECT_FALSE(do_parts_overlap({1, 1, -1, -1}, 0, {-1, -1, 1, 1}, 2)) << "halves that touch";
  EXPECT_FALSE(do_parts_overlap({1, 1, -2, -2}, 0, {-2, -2, 1, 1}, 2));
  const WallHeights two_corners{1, -2, 1, -2};
  EXPECT_TRUE(do_parts_overlap(two_corners, 0, {1, -2, -2, -2}, 0));
  EXPECT_FALSE(do_parts_overlap(two_corners, 2, {1, -2, -2, -2}, 0)) << "of two parts only the other one does";
  EXPECT_TRUE(do_parts_overlap(two_corners, 2, two_corners, 2));
  EXPECT_FALSE(do_parts_overlap(two_corners, 2, two_corners, 0));
  EXPECT_FALSE(do_parts_overlap({1, -1, 1, -1}, 0, {1, -1, 1, -1}, 2)) << "they touch at the saddle";
}

TEST(WallOverlap, DoesNotDependOnTheOrder) {
  const std::array<double, 4> values{-2, -1, 1, 3};
  const auto turned = [](const std::array<double, 4>& f) { return std::array{f[1], f[2], f[3], f[0]}; };
  const auto mirrored = [](const std::array<double, 4>& f) { return std::array{f[1], f[0], f[3], f[2]}; };
  for (int n = 0; n < 256; ++n) {
    const std::array<double, 4> a{values[n & 3], values[n >> 2 & 3], values[n >> 4 & 3], values[n >> 6]};
    for (int m = 0; m < 256; ++m) {
      const std::array<double, 4> b{values[m & 3], values[m >> 2 & 3], values[m >> 4 & 3], values[m >> 6]};
      const int euler = euler_of_overlap(a, b);
      ASSERT_EQ(euler_of_overlap(b, a), euler) << n << ' ' << m;
      ASSERT_EQ(euler_of_overlap(turned(a), turned(b)), euler) << n << ' ' << m;
      ASSERT_EQ(euler_of_overlap(mirrored(a), mirrored(b)), euler) << n << ' ' << m;
    }
  }
}

}  // namespace
}  // namespace scantet
