#include "scantet/topology/handle_cuts.h"

#include <gtest/gtest.h>

#include "scantet/base/union_find.h"
#include "scantet/topology/level_distance.h"
#include "scantet/topology/side_growth.h"
#include "unit/image/test_scan.h"

namespace scantet {
namespace {

using namespace test;

constexpr std::array<double, 3> kUnitSpacing{1, 1, 1};

class HandleCutsTest : public testing::Test {
 protected:
  template <class IsInside>
  void make(const IsInside& is_inside) {
    scan_ = scan_of_function<float>({19, 13, 13}, [&](int i, int j, int k) { return is_inside(i, j, k) ? 1 : -1; });
    heights_ = make_height_grid(scan_, {0, InsideSide::above, -1.0});
    nodes_ = std::make_unique<SidedNodes>(*heights_, [](double h) { return -h; });
    distances_ = level_distances(*nodes_, kUnitSpacing, 4);
    UnionFind sets(static_cast<std::size_t>(nodes_->nodes().count()));
    for (const bool inside : {true, false}) unite_side(*nodes_, inside, sets);
    sets.number_sets(component_of_);
  }
  HandleCuts cut(bool inside, double width_mm) {
    return cut_handles(*nodes_, inside, width_mm, kUnitSpacing, distances_, component_of_, Progress());
  }

  Scan scan_;
  std::unique_ptr<HeightGrid> heights_;
  std::unique_ptr<SidedNodes> nodes_;
  std::vector<float> distances_;
  std::vector<std::uint32_t> component_of_;
};

/// A block with a square hole through it along z.
bool has_hole(int half, int i, int j, int k) {
  const bool block = i >= 1 && i <= 17 && j >= 1 && j <= 11 && k >= 1 && k <= 11;
  return block && std::max(std::abs(i - 9), std::abs(j - 6)) > half;
}

TEST_F(HandleCutsTest, AHoleIsFilledAcross) {
  make([](int i, int j, int k) { return has_hole(1, i, j, k); });
  EXPECT_TRUE(cut(true, 4).made.empty()) << "the block is thick";
  const HandleCuts wide = cut(false, 3.3);
  EXPECT_TRUE(wide.made.empty()) << "three nodes, and beyond them: more than that from corner to corner";
  EXPECT_EQ(wide.wide.size(), 1U);
  EXPECT_EQ(count_cuts(*nodes_, false, wide.wide, distances_, component_of_), 1U);
  const HandleCuts cuts = cut(false, 4.5);
  ASSERT_EQ(cuts.made.size(), 1U);
  EXPECT_EQ(cuts.made[0].nodes.size(), 9U);
  EXPECT_EQ(cuts.made[0].handles, 1);
  EXPECT_FALSE(cuts.made[0].inside);
  EXPECT_NEAR(cuts.made[0].width_mm, 3.6, 0.3);
  for (const std::uint32_t n : cuts.made[0].nodes) {
    EXPECT_TRUE(nodes_->is_turned(n));
    EXPECT_EQ(component_of_[n], component_of_[nodes_->nodes().number({3, 3, 3})]);
  }
  EXPECT_TRUE(cut(false, 4.5).made.empty()) << "there is none left";
  EXPECT_TRUE(cut(true, 4.5).made.empty()) << "what was filled is not cut again";
}

TEST_F(HandleCutsTest, WallsOfCavitiesAndBridgesStay) {
  make([](int i, int j, int k) {  // a hollow block, and one beside it on a bridge
    const bool block = i >= 1 && i <= 9 && j >= 2 && j <= 10 && k >= 2 && k <= 10;
    const bool hollow = i >= 2 && i <= 8 && j >= 3 && j <= 9 && k >= 3 && k <= 9;
    return (block && !hollow) || (i >= 13 && i <= 17 && j >= 4 && j <= 8 && k >= 4 && k <= 8) ||
           (i > 9 && i < 13 && j == 6 && k == 6);
  });
  for (const double width_mm : {1.0, 2.0, 4.0, 8.0}) {
    for (const bool inside : {true, false}) EXPECT_TRUE(cut(inside, width_mm).made.empty());
  }
}

TEST_F(HandleCutsTest, OfThreeBridgesTwoAreCut) {
  make([](int i, int j, int k) {
    const bool block = j >= 1 && j <= 11 && k >= 1 && k <= 11 && ((i >= 1 && i <= 6) || (i >= 12 && i <= 17));
    const bool thick = std::max(std::abs(j - 6), std::abs(k - 6)) <= 1;
    const bool thin = k == 6 && (j == 2 || j == 10);
    return block || (i > 6 && i < 12 && (thick || thin));
  });
  const HandleCuts cuts = cut(true, 4);
  ASSERT_EQ(cuts.made.size(), 2U);
  for (const HandleCut& made : cuts.made) {
    EXPECT_EQ(made.nodes.size(), 1U);
    EXPECT_TRUE(made.inside);
    EXPECT_NE(nodes_->nodes().node(made.nodes[0])[1], 6) << "the thick one stays";
  }
}

}  // namespace
}  // namespace scantet
