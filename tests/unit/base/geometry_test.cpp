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
