// Voxels at the level against grids whose answer is plain.
#include "scantet/field/values_at_level.h"

#include <gtest/gtest.h>

#include <vector>

#include "unit/image/test_scan.h"

namespace scantet {
namespace {

using test::scan_of;

/// 5 × 5 × 5 voxels of 10 in a shell of 0, with three of 7 in them: one in the middle, two at the shell.
Scan block_with_holes() {
  constexpr int kSide = 7;
  std::vector<std::uint8_t> values(kSide * kSide * kSide, 0);
  const auto at = [&](int i, int j, int k) -> std::uint8_t& { return values[i + kSide * (j + kSide * k)]; };
  for (int k = 1; k < kSide - 1; ++k) {
    for (int j = 1; j < kSide - 1; ++j) {
      for (int i = 1; i < kSide - 1; ++i) at(i, j, k) = 10;
    }
  }
  at(3, 3, 3) = 7;  // parts the inside
  at(1, 3, 3) = 7;  // parts it along j and k
  at(1, 1, 1) = 7;  // a corner: parts nothing
  return scan_of({kSide, kSide, kSide}, values);
}

TEST(ValuesAtLevel, CountsVoxelsAndWhatTheyPart) {
  const ValuesAtLevel at = values_at_level(block_with_holes(), 7, InsideSide::above);
  EXPECT_EQ(at.voxels, 3);
  EXPECT_EQ(at.gaps, 2);
  EXPECT_DOUBLE_EQ(at.clear_level, 8.14) << "0.38 of the way to 10";
}

TEST(ValuesAtLevel, TakesTheOtherSide) {
  const ValuesAtLevel at = values_at_level(block_with_holes(), 7, InsideSide::below);
  EXPECT_EQ(at.voxels, 3);
  EXPECT_EQ(at.gaps, 0) << "none lies between two of the shell";
  EXPECT_DOUBLE_EQ(at.clear_level, 4.34) << "0.38 of the way to 0";
}

TEST(ValuesAtLevel, FindsNoneBetweenValues) {
  const ValuesAtLevel at = values_at_level(block_with_holes(), 7.5, InsideSide::above);
  EXPECT_EQ(at.voxels, 0);
  EXPECT_EQ(at.gaps, 0);
  EXPECT_EQ(at.clear_level, 7.5);
}

/// Two columns of 4 in 0 that share an edge three voxels long, and two of 12, with 4 beside these.
Scan columns() {
  constexpr int kSide = 8;
  std::vector<std::int16_t> values(kSide * kSide * 4, 0);
  for (int k = 0; k < 4; ++k) {
    const auto at = [&](int i, int j) -> std::int16_t& { return values[i + kSide * (j + kSide * k)]; };
    at(1, 1) = at(2, 2) = 4;
    at(5, 5) = at(6, 6) = 12;
    at(5, 6) = 4;
  }
  return scan_of({kSide, kSide, 4}, values);
}

TEST(ValuesAtLevel, CountsSaddlesHalfWay) {
  const ValuesAtLevel at = values_at_level(columns(), 2, InsideSide::above);
  EXPECT_EQ(at.voxels, 0);
  EXPECT_EQ(at.saddles, 4) << "one in each layer";
  EXPECT_DOUBLE_EQ(at.clear_level, 2.04) << "the branches are 0.2 voxels apart: 2 sqrt(2 x 0.04 / 8)";
  EXPECT_DOUBLE_EQ(values_at_level(columns(), 2, InsideSide::below).clear_level, 1.96);
  EXPECT_EQ(values_at_level(columns(), 2.5, InsideSide::above).saddles, 0);
}

TEST(ValuesAtLevel, SaddlesAreNotHeldAgainstALevelWithVoxels) {
  const ValuesAtLevel at = values_at_level(columns(), 4, InsideSide::above);
  EXPECT_EQ(at.voxels, 12);
  EXPECT_DOUBLE_EQ(at.clear_level, 4 + 0.38 * 8);
}

TEST(ValuesAtLevel, ClearLevelIsShortOfTheNextValue) {
  // Heights of 98 around the saddle, and a voxel 1 above the level.
  const Scan scan = scan_of({3, 2, 2}, std::vector<std::int16_t>{200, 4, 103, 4, 200, 4, 200, 4, 4, 4, 200, 4});
  const ValuesAtLevel at = values_at_level(scan, 102, InsideSide::above);
  EXPECT_EQ(at.saddles, 2);
  EXPECT_DOUBLE_EQ(at.clear_level, 102.24);
}

TEST(ValuesAtLevel, LooksInEveryPieceOfALargeScan) {
  constexpr int kSide = 50;  // 2,500 rows, three pieces
  std::vector<float> values(kSide * kSide * kSide, 2.0F);
  for (int n = 0; n < kSide; ++n) values[n + kSide * (n + kSide * n)] = 1.0F;
  const ValuesAtLevel at = values_at_level(scan_of({kSide, kSide, kSide}, values), 1, InsideSide::above);
  EXPECT_EQ(at.voxels, kSide);
  EXPECT_EQ(at.gaps, kSide - 2) << "the two in the corners of the image have no voxel beyond";
  EXPECT_DOUBLE_EQ(at.clear_level, 1.38);
}

}  // namespace
}  // namespace scantet
