#include "scantet/topology/level_ties.h"

#include <gtest/gtest.h>

#include "unit/image/test_scan.h"
#include "unit/topology/at_zero.h"
#include "unit/topology/side_shares.h"

namespace scantet {
namespace {

using test::kAtZero;

/// A block of nodes above the level, some of which are at it.
template <class AtLevel>
std::unique_ptr<HeightGrid> block(const AtLevel& at_level) {
  return make_height_grid(test::scan_of_function<double>({7, 7, 7},
                                                         [&](int i, int j, int k) {
                                                           const auto within = [](int n) { return n >= 1 && n <= 5; };
                                                           if (!within(i) || !within(j) || !within(k)) return -1;
                                                           return at_level(i, j, k) ? 0 : 1;
                                                         }),
                          kAtZero);
}

/// Eight times what is added below and above the level in these layers.
std::array<std::int64_t, 2> ties(const HeightGrid& heights, int first, int last) {
  std::array<std::int64_t, 2> sums{};
  count_ties(heights, first, last, Progress(), [&](const std::array<int, 3>& node, int eighths) {
    const double height = heights.height(node[0], node[1], node[2]);
    sums[height > 0 ? 1 : 0] += eighths;
  });
  return sums;
}

std::array<std::int64_t, 2> ties(const HeightGrid& heights) {
  return ties(heights, -1, heights.size()[2]);
}

TEST(LevelTies, AreNoneWhereNoNodeIsAtTheLevel) {
  const auto heights = block([](int, int, int) { return false; });
  count_ties(*heights, -1, 7, Progress(), [](const std::array<int, 3>&, int) { FAIL(); });
}

TEST(LevelTies, FillInWhatHasNoWidth) {
  const auto expect_ball = [](const HeightGrid& heights) {
    const auto shares = test::shares_of_sides(heights);
    const auto added = ties(heights);
    EXPECT_NE(shares[1], 8) << "else there is nothing to add";
    EXPECT_EQ(shares[1] + added[1], 8);
    EXPECT_EQ(shares[0] + added[0], 8);
  };
  expect_ball(*block([](int i, int j, int k) { return i == 3 && j == 3 && k == 3; }));
  expect_ball(*block([](int i, int j, int k) { return i == 3 && k == 3 && j > 1 && j < 5; }));
  expect_ball(*block([](int i, int j, int k) { return i == 3 && j > 1 && j < 5 && k > 1 && k < 5; }));
}

TEST(LevelTies, OfLayersAddUp) {
  const Scan scan = test::plateaus<std::uint8_t>({9, 8, 10}, {}, 5);
  const auto heights = make_height_grid(scan, {1, InsideSide::above, -1.0});
  const auto all = ties(*heights);
  EXPECT_NE(all, (std::array<std::int64_t, 2>{}));
  for (int cut = 0; cut < 10; ++cut) {
    auto sum = ties(*heights, -1, cut);
    const auto rest = ties(*heights, cut, 10);
    for (std::size_t side = 0; side < 2; ++side) sum[side] += rest[side];
    EXPECT_EQ(sum, all) << cut;
  }
}

}  // namespace
}  // namespace scantet
