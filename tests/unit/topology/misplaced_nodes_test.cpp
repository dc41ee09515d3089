// Meshes are stood for by sets of nodes that they have on the wrong side.
#include "scantet/topology/misplaced_nodes.h"

#include <gtest/gtest.h>

#include <set>

#include "unit/image/test_scan.h"

namespace scantet {
namespace {

using namespace test;
using Node = std::array<int, 3>;

constexpr std::array<int, 3> kCupSize{14, 12, 10};

/// A block with a shaft through it along z, and a thread that stands off like the handle of a cup.
bool is_inside(const Node& n) {
  const auto& [i, j, k] = n;
  if (i >= 2 && i <= 7 && j >= 2 && j <= 8 && k >= 2 && k <= 7) return i != 4 || j != 5;
  if (j != 5) return false;
  return (i == 8 && (k == 3 || k == 6)) || (i == 9 && k >= 3 && k <= 6);
}

Scan cup() {
  return scan_of_function<float>(kCupSize, [](int i, int j, int k) { return is_inside({i, j, k}) ? 1.0 : -1.0; });
}

/// The faces of the voxels of nodes, in two triangles each; those between two voxels twice, and so not there.
TriangleSurface voxels_of(const std::set<Node>& nodes, const Frame& frame) {
  TriangleSurface surface;
  for (const Node& n : nodes) {
    const auto first = static_cast<VertexId>(surface.vertices.size());
    for (int c = 0; c < 8; ++c) {
      const auto at = [&](int axis) { return n[static_cast<std::size_t>(axis)] + ((c >> axis & 1) != 0 ? 0.5 : -0.5); };
      surface.vertices.push_back(frame.to_world({at(0), at(1), at(2)}));
    }
    constexpr std::array<std::array<VertexId, 4>, 6> kFaces{
        {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
    for (const auto& [a, b, c, d] : kFaces) {
      surface.facets.push_back({first + a, first + b, first + c});
      surface.facets.push_back({first + a, first + c, first + d});
    }
  }
  return surface;
}

/// What is told of a mesh that has these nodes on the wrong side.
std::vector<Misplaced> told(const std::set<Node>& wrong, const PlaceFilter& is_asked = {}) {
  const Scan scan = cup();
  const auto heights = make_height_grid(scan, {0, InsideSide::above, -1.0});
  std::set<Node> in_mesh;
  for (int n = 0; n < kCupSize[0] * kCupSize[1] * kCupSize[2]; ++n) {
    const Node node{n % kCupSize[0], n / kCupSize[0] % kCupSize[1], n / (kCupSize[0] * kCupSize[1])};
    if (is_inside(node) != wrong.contains(node)) in_mesh.insert(node);
  }
  return misplaced_nodes(*heights, scan.frame, voxels_of(in_mesh, scan.frame), is_asked);
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

TEST(MisplacedNodes, WhereNothingIsAskedForNothingIsTold) {
  const Point thread = cup().frame.to_world({9, 5, 4});
  EXPECT_TRUE(told({{9, 5, 4}}, [&](const Point& p) { return distance(p, thread) > 0.5; }).empty());
  EXPECT_EQ(told({{9, 5, 4}}, [&](const Point& p) { return distance(p, thread) < 0.5; }).size(), 1U);
}

}  // namespace
}  // namespace scantet
