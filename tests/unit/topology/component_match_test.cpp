#include "scantet/topology/component_match.h"

#include <gtest/gtest.h>

#include "scantet/topology/sided_nodes.h"
#include "unit/image/test_scan.h"
#include "unit/topology/at_zero.h"

namespace scantet {
namespace {

using namespace test;
using Node = std::array<int, 3>;

/// Those of the nodes that are inside, as a scan of 1 and -1.
Scan nodes_inside(const std::vector<Node>& inside) {
  return scan_of_function<float>({7, 5, 5}, [&](int i, int j, int k) {
    return std::find(inside.begin(), inside.end(), Node{i, j, k}) != inside.end() ? 1 : -1;
  });
}

std::vector<Node> differing(const std::vector<Node>& before, const std::vector<Node>& after) {
  const Scan scans[2] = {nodes_inside(before), nodes_inside(after)};
  std::vector<Node> nodes;
  for (const std::int64_t n :
       differing_components(*make_height_grid(scans[0], kAtZero), *make_height_grid(scans[1], kAtZero), Progress())) {
    nodes.push_back(PaddedNodes{scans[0].size}.node(n));
  }
  return nodes;
}

TEST(ComponentMatch, NothingDiffersWhereComponentsGrowOrShrink) {
  EXPECT_TRUE(differing({{1, 2, 2}, {2, 2, 2}}, {{2, 2, 2}, {3, 2, 2}}).empty());
  EXPECT_TRUE(differing({{1, 2, 2}, {5, 2, 2}}, {{1, 2, 2}, {5, 2, 2}}).empty());
}

TEST(ComponentMatch, TellsTheSmallerOfTwoThatAreJoined) {
  const std::vector<Node> apart{{1, 2, 2}, {2, 2, 2}, {4, 2, 2}};
  const std::vector<Node> joined{{1, 2, 2}, {2, 2, 2}, {3, 2, 2}, {4, 2, 2}};
  const std::vector<Node> small{{4, 2, 2}};
  EXPECT_EQ(differing(apart, joined), small);
  EXPECT_EQ(differing(joined, apart), small);
}

TEST(ComponentMatch, TellsOfComponentsThatComeAndGo) {
  const std::vector<Node> one{{1, 2, 2}};
  const std::vector<Node> two{{1, 2, 2}, {4, 2, 2}};
  EXPECT_EQ(differing(one, two), (std::vector<Node>{{4, 2, 2}}));
  EXPECT_EQ(differing(two, one), (std::vector<Node>{{4, 2, 2}}));
}

TEST(ComponentMatch, CountsTheOutsideToo) {
  std::vector<Node> block;
  for (int k = 1; k <= 3; ++k) {
    for (int j = 1; j <= 3; ++j) {
      for (int i = 1; i <= 3; ++i) block.push_back({i, j, k});
    }
  }
  std::vector<Node> hollow = block;
  std::erase(hollow, Node{2, 2, 2});
  EXPECT_EQ(differing(block, hollow), (std::vector<Node>{{2, 2, 2}}));
  std::vector<Node> open = hollow;
  std::erase(open, Node{2, 2, 3});
  EXPECT_EQ(differing(hollow, open), (std::vector<Node>{{2, 2, 2}}));
}

}  // namespace
}  // namespace scantet
