#include <gtest/gtest.h>

#include "scantet/base/morton_impl.h"

namespace scantet {
namespace {

TEST(Morton, InterleavesTheBitsOfThreeCoordinates) {
  for (std::uint64_t bit = 0; bit < 21; ++bit) {
    const std::uint64_t step = std::uint64_t{1} << bit;
    EXPECT_EQ(interleave({step, 0, 0}), std::uint64_t{1} << (3 * bit));
    EXPECT_EQ(interleave({0, step, 0}), std::uint64_t{1} << (3 * bit + 1));
    EXPECT_EQ(interleave({0, 0, step}), std::uint64_t{1} << (3 * bit + 2));
  }
  EXPECT_EQ(interleave({3, 1, 2}), 0b101'011U);
  EXPECT_EQ(interleave({2097151, 2097151, 2097151}), (std::uint64_t{1} << 63) - 1);
  EXPECT_EQ(interleave({2097152, 0, 0}), 0U) << "higher bits do not count";
}

TEST(Morton, FillsTheBoxFromItsLeastCornerToItsGreatest) {
  const Box box{{-1, 2, 3}, {1, 4, 13}};
  EXPECT_EQ(morton_code(box.min, box), 0U);
  EXPECT_EQ(morton_code(box.max, box), (std::uint64_t{1} << 63) - 1);
  EXPECT_EQ(morton_code({0.5, 2.5, 5}, box) >> 60, 1U) << "in the half towards x";
  EXPECT_EQ(morton_code({-0.5, 2.5, 12}, box) >> 60, 4U) << "in the half towards z";
}

TEST(Morton, ABoxWithoutWidthHasAllAtItsBeginning) {
  EXPECT_EQ(morton_code({1, 2, 3}, {{1, 2, 3}, {1, 2, 3}}), 0U);
}

}  // namespace
}  // namespace scantet
