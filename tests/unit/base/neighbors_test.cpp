#include "scantet/base/neighbors.h"

#include <gtest/gtest.h>

#include <set>

namespace scantet {
namespace {

TEST(Neighborhood, HasEachCellThatTouchesOnceAndTheCellItselfInTheMiddle) {
  const std::set<NeighborOffset> all(kNeighborhood.begin(), kNeighborhood.end());
  EXPECT_EQ(all.size(), 27U);
  for (const NeighborOffset& offset : all) {
    for (const int step : offset) EXPECT_LE(std::abs(step), 1);
  }
  EXPECT_EQ(kNeighborhood[13], (NeighborOffset{0, 0, 0}));
}

/// Meshes depend on the order in which places are looked at.
TEST(Neighborhood, GoesAlongXFirstThenY) {
  for (int n = 0; n < 27; ++n) {
    EXPECT_EQ(kNeighborhood[static_cast<std::size_t>(n)], (NeighborOffset{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1}));
  }
  EXPECT_EQ(as_vec(kNeighborhood[5]), (Vec{1, 0, -1}));
}

TEST(Neighborhood, AlongAxesAreSixDownAndUp) {
  const std::array<int, 3> node{5, 6, 7};
  EXPECT_EQ(axis_neighbor(node, 0), (std::array<int, 3>{4, 6, 7}));
  EXPECT_EQ(axis_neighbor(node, 3), (std::array<int, 3>{5, 7, 7}));
  EXPECT_EQ(axis_neighbor(node, 4), (std::array<int, 3>{5, 6, 6}));
}

TEST(Neighborhood, DirectionsAreTheOffsetsWithoutTheCellItself) {
  std::size_t n = 0;
  for (const NeighborOffset& offset : kNeighborhood) {
    if (as_vec(offset) == Vec{}) continue;
    EXPECT_EQ(kNeighborDirections[n++], as_vec(offset));
  }
  EXPECT_EQ(n, kNeighborDirections.size());
}

}  // namespace
}  // namespace scantet
