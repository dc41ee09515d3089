#include "scantet/delaunay/circumcentre.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace scantet::engine {
namespace {

TEST(Circumcentre, IsEquidistantFromTheVertices) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    std::array<Point, 4> t;
    for (Point& p : t) p = {100 + unit(random), unit(random), unit(random)};
    const Point c = circumcentre(t);
    const double radius = distance(c, t[0]);
    for (const Point& p : t) EXPECT_NEAR(distance(c, p), radius, 1e-6 * radius * radius);
  }
}

TEST(Circumcentre, DoesNotDependOnTheOrderOfTheVertices) {
  std::array<Point, 4> t{Point{0.1, 0.2, 0.3}, Point{1.1, 0.3, -0.2}, Point{0.4, 1.7, 0.1}, Point{0.2, 0.1, 1.9}};
  const Point c = circumcentre(t);
  std::array<int, 4> order{0, 1, 2, 3};
  do {
    const Point again = circumcentre(std::array<Point, 4>{t[order[0]], t[order[1]], t[order[2]], t[order[3]]});
    EXPECT_EQ(again, c);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(Circumcentre, OfANearlyFlatTetIsExact) {
  // Four points of the unit circle, one lifted by 1e-12: doubles alone would lose every digit.
  const double lift = 0x1p-40;
  const std::array<Point, 4> t{Point{1, 0, 0}, Point{-1, 0, 0}, Point{0, 1, 0}, Point{0, -1, lift}};
  const Point c = circumcentre(t);
  EXPECT_NEAR(c.x, 0, 1e-12);
  EXPECT_NEAR(c.y, 0, 1e-12);
  EXPECT_NEAR(c.z, 0.5 * lift, 1e-12);
}

TEST(RadiusEdge, OfTriangles) {
  EXPECT_NEAR(radius_edge({0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}), 1 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(radius_edge({0, 0, 0}, {3, 0, 0}, {0, 4, 0}), 2.5 / 3, 1e-12);
  EXPECT_TRUE(std::isinf(radius_edge({0, 0, 0}, {1, 0, 0}, {2, 0, 0})));
}

}  // namespace
}  // namespace scantet::engine
