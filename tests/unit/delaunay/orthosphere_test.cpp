#include "scantet/delaunay/orthosphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scantet/delaunay/circumcentre.h"

namespace scantet::engine {
namespace {

double power(const WeightedPoint& p, const Point& x) {
  return squared_distance(p.point, x) - p.weight;
}

std::array<WeightedPoint, 4> random_tet(std::mt19937& random, double flatness = 1) {
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::uniform_real_distribution<double> weight(0, 0.3);
  std::array<WeightedPoint, 4> tet;
  for (WeightedPoint& p : tet) {
    p = {{coordinate(random), coordinate(random), flatness * coordinate(random)}, weight(random)};
  }
  return tet;
}

TEST(Orthosphere, HasOnePowerDistanceToAllVertices) {
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    const auto tet = random_tet(random);
    const Point center = orthocentre(tet);
    const double scale = squared_distance(center, tet[0].point) + 1;
    for (const WeightedPoint& p : tet) EXPECT_NEAR(power(p, center), power(tet[0], center), 1e-7 * scale);
  }
}

TEST(Orthosphere, IsTheCircumsphereWithoutWeights) {
  std::mt19937 random(2);
  auto tet = random_tet(random);
  for (WeightedPoint& p : tet) p.weight = 0;
  EXPECT_EQ(orthocentre(tet), circumcentre({tet[0].point, tet[1].point, tet[2].point, tet[3].point}));
  EXPECT_EQ(orthocentre(tet[0], tet[1], tet[2]), circumcentre(tet[0].point, tet[1].point, tet[2].point));
  EXPECT_NEAR(orthoradius_edge(tet[0], tet[1], tet[2]), radius_edge(tet[0].point, tet[1].point, tet[2].point), 1e-12);
}

TEST(Orthosphere, DoesNotDependOnTheOrder) {
  std::mt19937 random(3);
  auto tet = random_tet(random);
  const Point center = orthocentre(tet);
  std::swap(tet[0], tet[2]);
  std::swap(tet[1], tet[3]);
  EXPECT_EQ(orthocentre(tet), center);
}

TEST(Orthosphere, OfAFlatTetIsExact) {
  const std::array<WeightedPoint, 4> tet{
      {{{0, 0, 0}, 0.25}, {{1, 0, 0}, 0}, {{0, 1, 0}, 0}, {{1, 1, std::ldexp(1.0, -40)}, 0}}};
  double determinant = 0;
  EXPECT_TRUE(std::isnan(quick_orthocentre(tet, determinant).x));
  const Point center = orthocentre(tet);
  EXPECT_DOUBLE_EQ(center.x, 0.625);  // |c|² - 1/4 = |c - (1, 0, 0)|²
  EXPECT_DOUBLE_EQ(center.y, 0.625);
  // |c - (1, 1, h)|² = |c|² - 1/4 gives 2hz = 2 + h² + 1/4 - 2·2·0.625
  EXPECT_NEAR(center.z, -0.125 * std::ldexp(1.0, 40), 1);
}

TEST(Orthosphere, OfATriangleLiesInItsPlane) {
  const WeightedPoint a{{0, 0, 1}, 0.5}, b{{2, 0, 1}, 0}, c{{0, 2, 1}, 0};
  const Point center = orthocentre(a, b, c);
  EXPECT_DOUBLE_EQ(center.z, 1);
  EXPECT_NEAR(power(a, center), power(b, center), 1e-12);
  EXPECT_NEAR(power(a, center), power(c, center), 1e-12);
  EXPECT_NEAR(orthoradius_edge(a, b, c), std::sqrt(power(b, center)) / 2, 1e-12);
  EXPECT_EQ(orthoradius_edge({{0, 0, 0}, 9}, {{1, 0, 0}, 9}, {{0, 1, 0}, 9}), 0);  // the balls reach over the centre
}

}  // namespace
}  // namespace scantet::engine
