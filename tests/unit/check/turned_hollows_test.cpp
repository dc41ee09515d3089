#include "scantet/check/turned_hollows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "unit/quality/grid_mesh.h"

namespace scantet {
namespace {

/// Of a cube of 5³ cubes all but two.
Region with_hollows(int i, int j, int k) {
  const bool is_hollow = (i == 1 && j == 1 && k == 1) || (i == 3 && j == 3 && k == 2);
  return is_hollow ? kOutside : 1;
}

/// Mirrors the cube around a centre in it: its facets look the other way.
void turn_over(TetMesh& mesh, const Point& center) {
  for (Point& p : mesh.vertices) {
    const Vec off = p - center;
    if (std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}) < 0.6) p = center - off;
  }
}

TEST(TurnedHollows, NoneIsInAMeshWithHollowsAndAnIsland) {
  EXPECT_TRUE(turned_hollows(test::grid_mesh(5, with_hollows)).empty());
  const TetMesh island = test::grid_mesh(5, [](int i, int j, int k) {
    const int layer = std::max({std::abs(i - 2), std::abs(j - 2), std::abs(k - 2)});
    return layer == 1 ? kOutside : 1;
  });
  EXPECT_TRUE(turned_hollows(island).empty());
}

TEST(TurnedHollows, TheFacetsOfTheOneThatIsTurnedAreFound) {
  TetMesh mesh = test::grid_mesh(5, with_hollows);
  turn_over(mesh, {1.5, 1.5, 1.5});
  const std::vector<std::uint32_t> turned = turned_hollows(mesh);
  EXPECT_EQ(turned.size(), 12U) << "two for each side of the cube";
  EXPECT_TRUE(std::is_sorted(turned.begin(), turned.end()));
  for (const std::uint32_t f : turned) {
    for (const VertexId v : mesh.boundary_facets[f]) EXPECT_LT(distance(mesh.vertices[v], {1.5, 1.5, 1.5}), 1);
  }
}

TEST(TurnedHollows, WhatPartsRegionsIsNone) {
  TetMesh mesh = test::grid_mesh(5, [](int i, int j, int k) { return with_hollows(i, j, k) == kOutside ? 2 : 1; });
  turn_over(mesh, {1.5, 1.5, 1.5});
  EXPECT_TRUE(turned_hollows(mesh).empty());
}

}  // namespace
}  // namespace scantet
