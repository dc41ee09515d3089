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
