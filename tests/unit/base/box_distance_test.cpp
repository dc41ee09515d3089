#include "scantet/base/box_distance.h"

#include <gtest/gtest.h>

namespace scantet {
namespace {

TEST(BoxDistance, IsToTheNearestFaceEdgeOrCorner) {
  const Box box{{0, 0, 0}, {1, 2, 3}};
  EXPECT_EQ(squared_distance(box, {0.5, 1, 3}), 0);
  EXPECT_EQ(squared_distance(box, {-2, 1, 1}), 4) << "a face";
  EXPECT_EQ(squared_distance(box, {2, 4, 1}), 5) << "an edge";
  EXPECT_EQ(squared_distance(box, {2, 4, -2}), 9) << "a corner";
}

TEST(BoxDistance, OfAnEmptyBoxIsInfinite) {
  EXPECT_EQ(squared_distance(Box{}, {1, 2, 3}), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace scantet
