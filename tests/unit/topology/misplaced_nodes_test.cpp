// Meshes are stood for by sets of nodes that they have on the wrong side.
#include "scantet/topology/misplaced_nodes.h"

#include <gtest/gtest.h>

#include <set>

#include "unit/image/test_scan.h"

namespace scantet {
namespace {

using namespace test;
using Node = std::array<int, 3>;

constexpr std::array<int, 3> kSize{14, 12, 10};

/// A block with a shaft through it along z, and a thread that stands off like the handle of a cup.
bool is_inside(const Node& n) {
  const auto& [i, j, k] = n;
  if (i >= 2 && i <= 7 && j >= 2 && j <= 8 && k >= 2 && k <= 7) return i != 4 || j != 5;
  if (j != 5) return false;
  return (i == 8 && (k == 3 || k == 6)) || (i == 9 && k >= 3 && k <= 6);
}

Scan cup() {
  return scan_of_function<float>(kSize, [](int i, int j, int k) { return is_inside({i, j, k}) ? 1.0 : -1.0; });
}

/// What is told of a mesh that has these nodes on the wrong side.
std::vector<Misplaced> told(const std::set<Node>& wrong) {
  const Scan scan = cup();
  const auto heights = make_height_grid(scan, {0, InsideSide::above, -1.0});
  return misplaced_nodes(*heights, scan.frame, [&](std::span<const Point> points, std::span<Region> regions) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec at = scan.frame.to_index(points[i]);
      const Node n{int(std::lround(at.x)), int(std::lround(at.y)), int(std::lround(at.z))};
      regions[i] = is_inside(n) != wrong.contains(n) ? 1 : kOutside;
    }
  });
}

TEST(MisplacedNodes, AMeshThatHasAllNodesRightHasNone) {
  EXPECT_TRUE(told({}).empty());
}

TEST(MisplacedNodes, BumpsAndDentsDoNotCount) {
  EXPECT_TRUE(told({{2, 2, 2}, {2, 3, 2}, {7, 8, 5}}).empty()) << "edges and corners cut off";
  EXPECT_TRUE(told({{4, 3, 8}, {5, 3, 8}, {1, 5, 4}}).empty()) << "bumps on faces";
}

TEST(MisplacedNodes, AThreadThatIsCutCounts) {
  const std::vector<Misplaced> found = told({{9, 5, 4}, {2, 2, 2}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].region, 1);
  EXPECT_LT(distance(found[0].point, cup().frame.to_world({9, 5, 4})), 1e-9);
}

TEST(MisplacedNodes, AShaftThatIsStoppedCountsAsOneGroup) {
  const std::vector<Misplaced> found = told({{4, 5, 4}, {4, 5, 5}, {9, 5, 5}});
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].region, kOutside);
  EXPECT_EQ(found[0].group, found[1].group);
  EXPECT_NE(found[1].group, found[2].group) << "the thread is another place";
}

}  // namespace
}  // namespace scantet
