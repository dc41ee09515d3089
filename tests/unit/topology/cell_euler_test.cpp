#include "scantet/topology/cell_euler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "scantet/base/union_find.h"
#include "unit/image/test_scan.h"
#include "unit/topology/at_zero.h"
#include "unit/topology/side_shares.h"

namespace scantet {
namespace {

using test::kAtZero;

/// A ball, a ring and a hollow ball beside each other; no node is at the level.
double figure(int i, int j, int k) {
  const auto off = [&](double x, double y, double z) { return Vec{i - x, j - y, k - z}; };
  const double ball = 3.2 - length(off(5.1, 5.2, 6.1));
  const Vec ring = off(8.2, 16.1, 6.2);
  const double torus = 2.1 - std::hypot(std::hypot(ring.x, ring.y) - 4.6, ring.z);
  const double hollow = 2.1 - std::abs(3.4 - length(off(18.1, 7.3, 6.2)));
  return std::max({ball, torus, hollow});
}

TEST(CellEuler, SharesOfEachPartSumUpToItsNumber) {
  const auto heights = make_height_grid(test::scan_of_function<double>({25, 24, 13}, figure), kAtZero);
  UnionFind sets;
  sets.add();
  RunSweep first(*heights, -1, heights->size()[2]);
  while (first.advance(&sets)) {
  }
  std::vector<std::uint32_t> part_of;
  for (std::uint32_t label = 0; label < sets.size(); ++label) part_of.push_back(sets.find(label));
  std::vector<std::int64_t> eighths(sets.size());
  RunSweep sweep(*heights, -1, heights->size()[2]);
  while (sweep.advance(nullptr)) {
    if (sweep.k() >= 0) add_cell_shares(*heights, sweep, part_of, eighths);
  }
  std::multiset<std::int64_t> numbers;
  for (std::uint32_t label = 0; label < sets.size(); ++label) {
    if (sets.find(label) == label) numbers.insert(eighths[label]);
  }
  // The ring 0, the ball 1 and the cavity 1, the hollow ball 2, and what is outside of ball, ring and hollow ball 2.
  EXPECT_EQ(numbers, (std::multiset<std::int64_t>{0, 8, 8, 16, 16}));
}

TEST(CellEuler, SidesOfFewNodesAgree) {
  // One for a node above, or for two that are joined through the middle of a face or through the body of a cell; two
  // for two that are apart. With other signs, these are cavities of the block around, or one that a tunnel makes a ring
  // of.
  const auto shares = [](double q, const auto& is_above) {
    const auto value = [&](int i, int j, int k) { return is_above(i, j, k) ? 1 : -q; };
    return test::shares_of_sides(*make_height_grid(test::scan_of_function<double>({5, 5, 5}, value), kAtZero));
  };
  using Shares = std::array<std::int64_t, 2>;
  const auto one = [](int i, int j, int k) { return i == 2 && j == 2 && k == 2; };
  const auto in_face = [](int i, int j, int k) { return i == j && k == 2 && (i == 1 || i == 2); };
  const auto in_body = [](int i, int j, int k) { return i == j && j == k && (i == 1 || i == 2); };
  EXPECT_EQ(shares(0.4, [](int, int, int) { return false; }), (Shares{0, 0})) << "nothing, and all of space less one";
  EXPECT_EQ(shares(0.4, one), (Shares{8, 8}));
  EXPECT_EQ(shares(0.9, in_face), (Shares{8, 8}));
  EXPECT_EQ(shares(1.1, in_face), (Shares{16, 16}));
  EXPECT_EQ(shares(0.3, in_body), (Shares{8, 8}));
  EXPECT_EQ(shares(0.4, in_body), (Shares{16, 16}));
  const auto block_without = [](const auto& holes) {
    return [&holes](int i, int j, int k) {
      return std::min({i, j, k}) > 0 && std::max({i, j, k}) < 4 && !holes(i, j, k);
    };
  };
  const auto channels = [](int i, int j, int k) {  // from below and from above, to the ends of a cell's diagonal
    return (i == 1 && j == 1 && k <= 1) || (i == 2 && j == 2 && k >= 2);
  };
  EXPECT_EQ(shares(1, block_without(one)), (Shares{16, 16}));
  EXPECT_EQ(shares(1 / 0.3, block_without(channels))[0], shares(1 / 0.3, block_without(channels))[1]);
}

}  // namespace
}  // namespace scantet
