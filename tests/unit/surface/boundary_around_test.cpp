#include <gtest/gtest.h>

#include "scantet/base/neighbors.h"
#include "scantet/domain/analytic.h"
#include "scantet/surface/boundary_around_impl.h"

namespace scantet::engine {
namespace {

TEST(BoundaryAround, HasPointsInAllDirectionsFromTheMiddle) {
  const std::unique_ptr<Domain> sphere = make_sphere({}, 3);
  const BoundaryAround around = boundary_around(*sphere, {}, kNeighborDirections, 100);
  ASSERT_EQ(around.points.size(), 26U);
  for (const Point& p : around.points) EXPECT_NEAR(length(p), 3, 1e-9);
  EXPECT_NEAR(around.apart_mm, 0.7 * 3, 1e-9);
}

TEST(BoundaryAround, HasNoneThatIsTwiceAsFarAsTheNearest) {
  const std::unique_ptr<Domain> sphere = make_sphere({}, 3);
  const Point place{2, 0, 0};
  const BoundaryAround around = boundary_around(*sphere, place, kNeighborDirections, 100);
  ASSERT_FALSE(around.points.empty());
  EXPECT_LT(around.points.size(), 26U);
  for (const Point& p : around.points) EXPECT_LE(distance(p, place), 2 + 1e-9);
  EXPECT_NEAR(around.apart_mm, 0.7, 1e-9);
}

TEST(BoundaryAround, HasNoneBeyondItsReach) {
  const std::unique_ptr<Domain> sphere = make_sphere({}, 3);
  EXPECT_TRUE(boundary_around(*sphere, {}, kNeighborDirections, 2.9).points.empty());
}

}  // namespace
}  // namespace scantet::engine
