#include "scantet/base/geometry.h"

#include <gtest/gtest.h>

#include "scantet/base/tet_mesh.h"

namespace scantet {
namespace {

TEST(Geometry, CrossProductIsRightHanded) {
  EXPECT_EQ(cross({1, 0, 0}, {0, 1, 0}), (Vec{0, 0, 1}));
}

TEST(Geometry, EmptyBoxContainsNothing) {
  Box box;
  EXPECT_TRUE(box.empty());
  EXPECT_FALSE(box.contains({0, 0, 0}));
  box.extend({1, 2, 3});
  EXPECT_FALSE(box.empty());
  EXPECT_TRUE(box.contains({1, 2, 3}));
}

TEST(Geometry, AnEmptyBoxMeetsNothingAndAddsNothing) {
  const Box box{{0, 0, 0}, {1, 2, 3}};
  EXPECT_FALSE(box.meets(Box{}));
  EXPECT_FALSE(Box{}.meets(box));
  Box same = box;
  same.unite(Box{});
  EXPECT_EQ(same.min, box.min);
  EXPECT_EQ(same.max, box.max);
}

TEST(Geometry, BoxesThatTouchMeet) {
  const Box box{{0, 0, 0}, {1, 2, 3}};
  EXPECT_TRUE(box.meets({{1, 2, 3}, {4, 4, 4}}));
  EXPECT_FALSE(box.meets({{0, 0, 3.5}, {1, 2, 4}}));
  EXPECT_TRUE(box.meets(Box{{0, 0, 3.5}, {1, 2, 4}}.grown(0.5)));
}

TEST(Geometry, CornersOfABoxCountInXFirst) {
  const Box box{{0, 0, 0}, {1, 2, 3}};
  EXPECT_EQ(box.corner(0), box.min);
  EXPECT_EQ(box.corner(1), (Point{1, 0, 0}));
  EXPECT_EQ(box.corner(6), (Point{0, 2, 3}));
  EXPECT_EQ(box.corner(7), box.max);
}

TEST(Geometry, LexicographicOrderIsTotal) {
  EXPECT_TRUE(lexicographically_less({0, 5, 5}, {1, 0, 0}));
  EXPECT_TRUE(lexicographically_less({0, 0, 1}, {0, 0, 2}));
  EXPECT_FALSE(lexicographically_less({0, 0, 1}, {0, 0, 1}));
}

TEST(Geometry, OrientationIsSixTimesTheVolume) {
  EXPECT_DOUBLE_EQ(orientation_mm3({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}), 8);
  EXPECT_DOUBLE_EQ(orientation_mm3({0, 0, 0}, {0, 2, 0}, {2, 0, 0}, {0, 0, 2}), -8);
}

}  // namespace
}  // namespace scantet
