#include "scantet/sizing/boundary_size.h"

#include <gtest/gtest.h>

namespace scantet {
namespace {

TEST(BoundarySize, GrowsByTheDistanceFromTheBoundary) {
  const BoundarySize size({{{0, 0, 0}, 1}, {{1, 0, 0}, 2}, {{2, 0, 0}, 4}}, 0.5, false);
  EXPECT_EQ(size.size_at({0, 0, 0}), 1);
  EXPECT_EQ(size.size_at({0, 0, 0.5}), 1);  // no further from the sample than its spacing
  EXPECT_EQ(size.size_at({0, 0, 3}), 3.5);
  EXPECT_EQ(size.size_up_to({0, 0, 3}, 4), 3.5);
  EXPECT_EQ(size.size_up_to({0, 0, 3}, 2), 2);
  EXPECT_EQ(size.min_size(), 1);
  EXPECT_EQ(size.usual_size(), 2);
  EXPECT_FALSE(size.bounds_tets());
}

}  // namespace
}  // namespace scantet
