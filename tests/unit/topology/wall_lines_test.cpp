#include "scantet/topology/wall_lines.h"

#include <gtest/gtest.h>

namespace scantet {
namespace {

WallHeights negative(WallHeights heights) {
  for (double& height : heights) height = -height;
  return heights;
}

/// (u - c)·(v - d) at the corners around the square.
WallHeights product(double c, double d) {
  return {c * d, (c - 1) * d, (1 - c) * (1 - d), c * (d - 1)};
}

constexpr WallHeights kHalf{1, 1, -1, -1};
constexpr WallHeights kStrip{2, -1, 2, -1};

TEST(WallLines, OfFunctionsThatAreProportional) {
  EXPECT_EQ(touching_lines(kHalf, kHalf), 0) << "the same half";
  EXPECT_EQ(touching_lines(kHalf, {-2, -2, 2, 2}), 1);
  EXPECT_EQ(touching_lines(kStrip, negative(kStrip)), 2) << "along both sides of the strip";
  EXPECT_EQ(touching_lines(product(0.5, 0.25), negative(product(0.5, 0.25))), 4) << "the arms of a cross";
  EXPECT_EQ(touching_lines({1, 1, 1, 1}, {-1, -1, -1, -1}), 0) << "no line";
}

TEST(WallLines, OfProductsWithACommonFactor) {
  EXPECT_EQ(touching_lines({0, 0, 1, -1}, {1, -1, 0, 0}), 1) << "(u - 1/2)·v and (u - 1/2)·(v - 1)";
  EXPECT_EQ(touching_lines(kHalf, product(0.25, 0.5)), 1) << "beside one arm of the cross";
  EXPECT_EQ(touching_lines(product(0.5, 0.25), product(0.5, 0.75)), 1) << "between the saddles";
  EXPECT_EQ(touching_lines(product(0.5, 0.25), negative(product(0.5, 0.75))), 2) << "beyond both of them";
  EXPECT_EQ(touching_lines(product(0.5, 0.25), product(0.25, 0.75)), 0) << "no common line";
}

TEST(WallLines, DoNotDependOnTheOrder) {
  const std::array<double, 4> values{-1, 0, 1, 2};
  const auto turned = [](const WallHeights& f) { return WallHeights{f[1], f[2], f[3], f[0]}; };
  const auto mirrored = [](const WallHeights& f) { return WallHeights{f[1], f[0], f[3], f[2]}; };
  for (int n = 0; n < 256; ++n) {
    const WallHeights a{values[n & 3], values[n >> 2 & 3], values[n >> 4 & 3], values[n >> 6]};
    for (int m = 0; m < 256; ++m) {
      const WallHeights b{values[m & 3], values[m >> 2 & 3], values[m >> 4 & 3], values[m >> 6]};
      const int share = wall_line_shares({a, b});
      ASSERT_EQ(wall_line_shares({b, a}), share) << n << ' ' << m;
      ASSERT_EQ(wall_line_shares({turned(a), turned(b)}), share) << n << ' ' << m;
      ASSERT_EQ(wall_line_shares({mirrored(a), mirrored(b)}), share) << n << ' ' << m;
    }
  }
}

}  // namespace
}  // namespace scantet
