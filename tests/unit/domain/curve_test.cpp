#include "scantet/domain/curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "error_code.h"
#include "scantet/base/error.h"

namespace scantet {
namespace {

std::vector<Point> circle(int pieces) {
  std::vector<Point> points;
  for (int i = 0; i < pieces; ++i) {
    const double angle = 2 * M_PI * i / pieces;
    points.push_back({std::cos(angle), std::sin(angle), 0.1 * std::sin(3 * angle)});
  }
  points.push_back(points.front());
  return points;
}

std::string code_of(const std::vector<Point>& points, bool closed) {
  return test::error_code([&] {
    const PolylineCurve curve(points, {}, closed ? std::nullopt : std::optional(std::array<std::size_t, 2>{0, 1}));
  });
}

TEST(PolylineCurve, IsParametrisedByArcLength) {
  const PolylineCurve curve({{0, 0, 0}, {3, 0, 0}, {3, 4, 0}}, {0, 1, 2}, std::array<std::size_t, 2>{4, 5}, "rim");
  EXPECT_DOUBLE_EQ(curve.length_mm(), 7);
  EXPECT_EQ(curve.at(1), (Point{1, 0, 0}));
  EXPECT_EQ(curve.at(5), (Point{3, 2, 0}));
  EXPECT_EQ(curve.at(-1), (Point{0, 0, 0}));
  EXPECT_EQ(curve.at(8), (Point{3, 4, 0}));
  EXPECT_EQ(curve.name(), "rim");
  EXPECT_EQ(curve.corners()->at(1), 5U);
}

TEST(PolylineCurve, FindsTheNearestPointAmongAll) {
  const PolylineCurve curve(circle(200), {0, 1, 2}, std::nullopt);
  std::mt19937 random{7};
  std::uniform_real_distribution<double> coordinate(-2, 2);
  for (int i = 0; i < 500; ++i) {
    const Point p{coordinate(random), coordinate(random), coordinate(random)};
    const Curve::Nearest nearest = curve.nearest(p);
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= 20'000; ++k) least = std::min(least, distance(p, curve.at(curve.length_mm() * k / 20'000)));
    EXPECT_NEAR(nearest.distance_mm, least, 1e-3);
    EXPECT_LE(nearest.distance_mm, least + 1e-12);
    EXPECT_NEAR(distance(curve.at(nearest.along_mm), nearest.point), 0, 1e-12);
    EXPECT_NEAR(distance(p, nearest.point), nearest.distance_mm, 1e-12);
  }
}

TEST(PolylineCurve, RefusesWhatIsNoCurve) {
  EXPECT_EQ(code_of({{0, 0, 0}}, false), "usage.curve");
  EXPECT_EQ(code_of({{0, 0, 0}, {0, 0, 0}}, false), "usage.curve");
  EXPECT_EQ(code_of({{0, 0, 0}, {std::nan(""), 0, 0}}, false), "usage.curve");
  EXPECT_EQ(code_of({{0, 0, 0}, {1, 0, 0}}, true), "usage.curve");
  EXPECT_EQ(code_of(circle(8), true), "");
}

}  // namespace
}  // namespace scantet
