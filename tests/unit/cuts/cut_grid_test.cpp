// What planes leave of a grid of regions.
#include "scantet/cuts/cut_grid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scantet {
namespace {

/// 10³ nodes, 1 mm apart: region 1 with its x from 0 to 3, and from 7 to 9, in a part each; region 2 from 5 to 6.
RegionGrid three_slabs() {
  RegionGrid grid;
  grid.size = {10, 10, 10};
  grid.parts = {{1, 400, {0, 0, 0}}, {2, 200, {5, 0, 0}}, {1, 300, {7, 0, 0}}};
  for (int k = 0; k < 10; ++k) {
    for (int j = 0; j < 10; ++j) {
      grid.runs.push_back({j, k, 0, 4, 0});
      grid.runs.push_back({j, k, 5, 7, 1});
      grid.runs.push_back({j, k, 7, 10, 2});
    }
  }
  grid.regions = {{1, 700, 690}, {2, 200, 190}};
  return grid;
}

TEST(CutGrid, NodesBeyondAPlaneAreGone) {
  const RegionGrid cut = cut_grid(three_slabs(), {{{-1, 0, 0}, -2.5, "cut_1"}});
  ASSERT_EQ(cut.regions.size(), 2U);
  EXPECT_EQ(cut.regions[0].nodes, 400U);
  EXPECT_TRUE(std::isnan(cut.regions[0].volume_mm3)) << "it is cut";
  EXPECT_EQ(cut.regions[1].nodes, 200U);
  EXPECT_EQ(cut.regions[1].volume_mm3, 190) << "the plane does not come near";
  ASSERT_EQ(cut.parts.size(), 3U);
  EXPECT_EQ(cut.parts[0].nodes, 100U);
  EXPECT_EQ(cut.parts[0].node[0], 3);
  EXPECT_EQ(cut.runs.size(), 300U);
  const RegionGrid on_nodes = cut_grid(three_slabs(), {{{1, 0, 0}, 5, "cut_1"}});
  ASSERT_EQ(on_nodes.regions.size(), 1U) << "what lies on the plane is cut off, and region 2 with it";
  EXPECT_EQ(on_nodes.regions[0].nodes, 400U);
  EXPECT_EQ(on_nodes.parts.size(), 1U);
}

TEST(CutGrid, TheBorderTakesNoNode) {
  const RegionGrid grid = three_slabs();
  const RegionGrid cut = cut_grid(grid, border_planes(grid.frame, {0, -1, -1}, {9, 10, 10}));
  ASSERT_EQ(cut.regions.size(), 2U);
  EXPECT_EQ(cut.regions[0].nodes, 700U);
  EXPECT_TRUE(std::isnan(cut.regions[0].volume_mm3));
  EXPECT_EQ(cut.regions[1].nodes, 200U);
  EXPECT_EQ(cut.regions[1].volume_mm3, 190);
  EXPECT_EQ(cut.parts.size(), 3U);
}

}  // namespace
}  // namespace scantet
