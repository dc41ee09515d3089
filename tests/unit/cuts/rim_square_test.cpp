#include "scantet/cuts/rim_square.h"

#include <gtest/gtest.h>

#include <numbers>

namespace scantet {
namespace {

/// Crossings around a circle; `word` has the region before each of them.
std::vector<BorderCrossing> around(const std::vector<Region>& word) {
  std::vector<BorderCrossing> crossings;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(word.size());
    crossings.push_back(
        {static_cast<std::uint32_t>(i), {std::cos(angle), std::sin(angle), 0}, word[i], word[(i + 1) % word.size()]});
  }
  return crossings;
}

SquareLines lines_of(const std::vector<Region>& word, Region middle) {
  return join_crossings(around(word), [&](const Point&) { return middle; });
}

TEST(RimSquare, TwoRegionsHaveOneLine) {
  const SquareLines lines = lines_of({0, 1}, 1);
  ASSERT_EQ(lines.joins.size(), 1U);
  EXPECT_TRUE(lines.junction.empty());
  EXPECT_EQ(lines.joins[0].start.from, lines.joins[0].end.to);
}

TEST(RimSquare, MiddleDecidesWhatHangsTogether) {
  for (const Region middle : {0, 1}) {
    const SquareLines lines = lines_of({0, 1, 0, 1}, middle);
    ASSERT_EQ(lines.joins.size(), 2U);
    for (const auto& join : lines.joins) {
      const auto [low, high] = std::minmax(join.start.node, join.end.node);
      EXPECT_EQ(high - low == 1 && low % 2 == 0, middle == 0) << "each line is around the other region";
    }
  }
}

TEST(RimSquare, NestedRegionsHaveNoJunction) {
  const SquareLines lines = lines_of({0, 1, 2, 1}, 1);
  EXPECT_EQ(lines.joins.size(), 2U);
  EXPECT_TRUE(lines.junction.empty());
}

TEST(RimSquare, ThreeRegionsMeet) {
  const SquareLines lines = lines_of({0, 1, 2}, 1);
  EXPECT_TRUE(lines.joins.empty());
  EXPECT_EQ(lines.junction.size(), 3U);
}

TEST(RimSquare, AFourthOneBesideAJunctionIsTakenOff) {
  const SquareLines lines = lines_of({0, 1, 2, 3, 2}, 1);
  EXPECT_EQ(lines.joins.size(), 1U);
  EXPECT_EQ(lines.junction.size(), 3U);
}

}  // namespace
}  // namespace scantet
