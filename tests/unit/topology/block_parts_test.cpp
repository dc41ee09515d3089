#include "scantet/topology/block_parts.h"

#include <gtest/gtest.h>

#include <random>

#include "scantet/base/neighbors.h"
#include "scantet/topology/level_topology.h"
#include "unit/image/parts_of_samples.h"
#include "unit/image/test_scan.h"
#include "unit/topology/at_zero.h"
#include "unit/topology/side_shares.h"

namespace scantet {
namespace {

using namespace test;

/// Three nodes along each axis.
Scan block(const std::array<double, 27>& heights) {
  return scan_of_function<double>({3, 3, 3}, [&](int i, int j, int k) { return heights[i + 3 * j + 9 * k]; });
}

/// A block of 5 x 5 x 5 nodes of random heights, and the same with its middle turned.
struct TurnedBlock {
  Scan before;
  Scan after;
};
TurnedBlock random_block(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> height(-1, 1);
  std::vector<double> values(125);
  for (double& h : values) h = height(random);
  std::vector<double> turned = values;
  turned[62] = -turned[62];
  return {scan_of<double>({5, 5, 5}, values), scan_of<double>({5, 5, 5}, turned)};
}

TEST(SideChanges, EulerNumbersChangeAsThoseOfTheWholeField) {
  int changed = 0;
  for (unsigned seed = 1; seed <= 3000; ++seed) {
    const TurnedBlock around = random_block(seed);
    const auto heights = make_height_grid(around.before, kAtZero);
    const SidedNodes nodes(*heights, opposite);
    const SideChange change = SideChanges(nodes).look_at(nodes.nodes().number({2, 2, 2}));
    const auto euler = [](const Scan& scan) { return shares_of_sides(*make_height_grid(scan, kAtZero))[1]; };
    ASSERT_EQ(8 * change.euler(), euler(around.after) - euler(around.before)) << seed;
    changed += change.euler() != 0 ? 1 : 0;
  }
  EXPECT_GT(changed, 500);
}

TEST(SideChanges, SimpleOnesChangeNothing) {
  int simple = 0;
  int plain = 0;
  for (unsigned seed = 1; seed <= 3000; ++seed) {
    const TurnedBlock around = random_block(seed);
    const auto heights = make_height_grid(around.before, kAtZero);
    const SidedNodes nodes(*heights, opposite);
    SideChanges changes(nodes);
    const std::int64_t middle = nodes.nodes().number({2, 2, 2});
    const bool is = is_simple(changes.look_at(middle));
    const bool is_plainly = changes.is_plainly_simple(middle);
    EXPECT_EQ(changes.is_plainly_simple(middle), is_plainly) << "from memory";
    if (is_plainly) {
      ASSERT_TRUE(is) << seed;
      ++plain;
    }
    if (!is) continue;
    ++simple;
    const LevelTopology before(around.before, kAtZero);
    const LevelTopology after(around.after, kAtZero);
    ASSERT_EQ(counts(before), counts(after)) << seed;
    std::int64_t difference = 0;
    for (const Component& c : before.components()) difference += c.region == kOutside ? 0 : c.handles().value();
    for (const Component& c : after.components()) difference -= c.region == kOutside ? 0 : c.handles().value();
    ASSERT_EQ(difference, 0) << seed;
  }
  EXPECT_GT(simple, 200);
  EXPECT_GT(plain, 5);
}

TEST(SideChanges, PartsAreThoseOfTheEightCells) {
  std::array<double, 27> heights;
  heights.fill(-1);
  heights[0] = heights[26] = 2;  // corners across the block
  heights[13] = -0.1;
  const Scan scan = block(heights);
  const auto grid = make_height_grid(scan, kAtZero);
  const SidedNodes nodes(*grid, [](double h) { return -100 * h; });
  SideChanges changes(nodes);
  const std::int64_t middle = nodes.nodes().number({1, 1, 1});
  const SideChange change = changes.look_at(middle);
  EXPECT_FALSE(changes.is_plainly_simple(middle));
  EXPECT_NE(change.before.part[0], change.before.part[26]);
  EXPECT_EQ(change.after.part[0], change.after.part[26]) << "through the bodies of two cells";
  EXPECT_EQ(change.after.part[13], change.after.part[0]);
  EXPECT_EQ(change.euler(), -1);
  EXPECT_FALSE(is_simple(change));
}

TEST(SideChanges, ANodeAtTheLevelIsBelowIt) {
  std::array<double, 27> heights;
  heights.fill(0);
  heights[12] = 1;
  const Scan scan = block(heights);
  const auto grid = make_height_grid(scan, {0, InsideSide::above, -1.0});
  const SidedNodes nodes(*grid, [](double) { return 1.0; });
  const std::int64_t middle = nodes.nodes().number({1, 1, 1});
  EXPECT_FALSE(nodes.inside(middle));
  EXPECT_LT(nodes.height(middle, {1, 1, 1}), 0);
  EXPECT_EQ(nodes.turned_height(middle, {1, 1, 1}), 1);
  EXPECT_TRUE(is_simple(SideChanges(nodes).look_at(middle)));
}

}  // namespace
}  // namespace scantet
