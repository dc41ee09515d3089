#include "scantet/topology/side_growth.h"

#include <gtest/gtest.h>

#include <set>

#include "scantet/topology/level_distance.h"
#include "unit/image/test_scan.h"
#include "unit/topology/at_zero.h"

namespace scantet {
namespace {

using namespace test;

/// A scan at level 0 with all that growing takes.
struct Field {
  Scan scan;
  std::unique_ptr<HeightGrid> heights;
  SidedNodes nodes;
  std::vector<float> distances;
  std::vector<std::uint32_t> component_of;

  explicit Field(const Scan& of)
      : scan(of),
        heights(make_height_grid(scan, {0, InsideSide::above, -1.0})),
        nodes(*heights, opposite),
        distances(level_distances(nodes, {1, 1, 1}, 3)) {
    UnionFind sets(static_cast<std::size_t>(nodes.nodes().count()));
    for (const bool inside : {true, false}) unite_side(nodes, inside, sets);
    sets.number_sets(component_of);
  }

  std::size_t inside_components() const {
    std::set<std::uint32_t> found;
    for (std::int64_t n = 0; n < nodes.nodes().count(); ++n) {
      if (nodes.inside(n)) found.insert(component_of[n]);
    }
    return found.size();
  }
};

/// Two blocks along x with `bridges` rows of nodes between them.
Scan blocks(int bridges) {
  return scan_of_function<float>({21, 11, 9}, [bridges](int i, int j, int k) {
    const bool block = j >= 1 && j <= 9 && k >= 1 && k <= 7 && ((i >= 1 && i <= 7) || (i >= 13 && i <= 19));
    const bool first = j == 2 && k == 4 && i > 7 && i < 13;
    const bool second = j == 7 && k == 4 && i > 7 && i < 13;
    return block || (first && bridges > 0) || (second && bridges > 1) ? 1 : -1;
  });
}

TEST(SideGrowth, UnitesWhatEdgesFacesAndBodiesJoin) {
  const auto pair = [](const std::array<int, 3>& step, double around) {
    return Field(scan_of_function<double>({6, 6, 6},
                                          [&](int i, int j, int k) {
                                            const bool first = i == 2 && j == 2 && k == 2;
                                            const bool second =
                                                i == 2 + step[0] && j == 2 + step[1] && k == 2 + step[2];
                                            return first || second ? 1 : around;
                                          }))
        .inside_components();
  };
  EXPECT_EQ(pair({1, 0, 0}, -5), 1U);
  EXPECT_EQ(pair({1, 1, 0}, -0.9), 1U);
  EXPECT_EQ(pair({1, 1, 0}, -1.1), 2U);
  EXPECT_EQ(pair({1, 1, 1}, -0.3), 1U);
  EXPECT_EQ(pair({1, 1, 1}, -0.4), 2U);
  EXPECT_EQ(pair({2, 0, 0}, -0.1), 2U);
}

TEST(SideGrowth, AllComesBackWhereThereIsNoHandle) {
  Field field(blocks(1));
  for (const bool inside : {true, false}) {
    Growth growth = grow_side(field.nodes, inside, 1.5, field.distances, field.component_of, Progress());
    EXPECT_TRUE(growth.groups.empty());
    if (inside) {
      const auto set = [&](int i) {
        return growth.sets.find(static_cast<std::uint32_t>(field.nodes.nodes().number({i, 4, 4})));
      };
      EXPECT_EQ(set(3), set(16)) << "by the bridge";
    }
  }
}

TEST(SideGrowth, AHandleIsLeftOpen) {
  Field field(blocks(2));
  const Growth growth = grow_side(field.nodes, true, 1.5, field.distances, field.component_of, Progress());
  ASSERT_EQ(growth.groups.size(), 1U);
  ASSERT_EQ(growth.groups[0].size(), 1U);
  const std::array<int, 3> node = field.nodes.nodes().node(growth.groups[0][0]);
  EXPECT_TRUE(node[0] > 7 && node[0] < 13 && node[2] == 4);
  for (std::int64_t n = 0; n < field.nodes.nodes().count(); ++n) EXPECT_FALSE(field.nodes.is_turned(n));
  // The bridges are thicker than that.
  EXPECT_TRUE(grow_side(field.nodes, true, 0.2, field.distances, field.component_of, Progress()).groups.empty());
}

}  // namespace
}  // namespace scantet
