// The tests of a facet's collar say yes where a field is plain, and no where the claim is false.
#include "scantet/verify/prism.h"

#include <gtest/gtest.h>

#include <vector>

#include "scantet/field/scan_from_memory.h"

namespace scantet::verify {
namespace {

/// z in a box of 6³ voxels, with a bump.
Scan slope(double bump) {
  std::vector<double> values;
  for (int k = 0; k < 6; ++k) {
    for (int j = 0; j < 6; ++j) {
      for (int i = 0; i < 6; ++i) values.push_back(k + (i == 2 && j == 2 && k == 2 ? bump : 0));
    }
  }
  return make_scan(std::move(values), {6, 6, 6}, Frame());
}

Prism prism_at(double z, double height) {
  Prism prism;
  prism.p = {IntervalVec(Vec{1.2, 1.3, z}), IntervalVec(Vec{3.1, 1.1, z}), IntervalVec(Vec{1.4, 3.2, z})};
  prism.e.fill(IntervalVec(Vec{0, 0, height}));
  return prism;
}

LevelSetSettings at_level(double level) {
  LevelSetSettings settings;
  settings.level = level;
  return settings;
}

TEST(Prism, CollarOfASlope) {
  const VoxelNodes nodes(slope(0), at_level(2.5));
  const Prism good = prism_at(2.4, 0.3);
  EXPECT_TRUE(unfolds(good));
  EXPECT_TRUE(rises(nodes, good, 100));
  EXPECT_TRUE(has_side(nodes, good, 1, 1, 100));
  EXPECT_TRUE(has_side(nodes, good, -1, -1, 100));
  EXPECT_FALSE(has_side(nodes, prism_at(2.4, 0.05), 1, 1, 10000));  // ends at 2.45, below the level
  Prism folded = good;
  std::swap(folded.p[0], folded.p[1]);
  EXPECT_FALSE(unfolds(folded));
  Prism crossing = good;
  crossing.e[0] = IntervalVec(Vec{3, 0, 0.3});
  EXPECT_FALSE(unfolds(crossing));
  EXPECT_FALSE(rises(nodes, prism_at(4.9, 0.3), 10000)) << "it reaches where the field falls to the outside value";
}

TEST(Prism, FieldThatFallsSomewhere) {
  EXPECT_TRUE(rises(VoxelNodes(slope(0.4), at_level(2.5)), prism_at(2.4, 0.3), 1000));
  EXPECT_FALSE(rises(VoxelNodes(slope(1.5), at_level(2.5)), prism_at(2.4, 0.3), 100000));
  EXPECT_FALSE(has_side(VoxelNodes(slope(1.5), at_level(2.5)), prism_at(2.2, 0.1), -1, -1, 100000));
}

TEST(Prism, TrianglesStayApart) {
  EXPECT_TRUE(stay_apart(prism_at(2, 0.2), prism_at(2.5, 0.2)));
  EXPECT_FALSE(stay_apart(prism_at(2, 0.2), prism_at(2, 0.2)));
  Prism other = prism_at(2.5, -0.3);  // they meet halfway
  EXPECT_FALSE(stay_apart(prism_at(2, 0.3), other));
  EXPECT_TRUE(stay_apart(prism_at(2, 0.3), prism_at(2.5, 0.3))) << "hulls meet, but no two triangles of one s";
}

}  // namespace
}  // namespace scantet::verify
