// Distances between triangles whose farthest points are known.
#include "scantet/verify/surface_distances.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace scantet::verify {
namespace {

TEST(SurfaceDistances, NearestTriangleIsFound) {
  const std::vector<Point> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
  const TriangleSet set(points, {{0, 1, 2}, {3, 4, 5}});
  EXPECT_EQ(set.count(), 2U);
  EXPECT_EQ(set.largest_mm(), 6);
  const TriangleSet::Nearest near = set.nearest({5.2, 0.2, -2});
  EXPECT_EQ(near.triangle, 1U);
  EXPECT_NEAR(near.distance_mm, 2, 1e-14);
  EXPECT_NEAR(set.distance_to(0, {5.0, 0.0, 0.0}), 4, 1e-14);
}

TEST(SurfaceDistances, FarthestPointMayBeInTheMiddle) {
  // A roof over a flat triangle: its ridge is farthest, and none of the flat triangle's corners is.
  const std::vector<Point> flat{{-4, -4, 0}, {4, -4, 0}, {0, 6, 0}};
  const std::vector<Point> roof{{-4, -4, 0}, {4, -4, 0}, {0, 6, 0}, {0, -0.5, 1}};
  const TriangleSet one(flat, {{0, 1, 2}});
  const TriangleSet three(roof, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  Progress progress;
  const auto to_roof = surface_distances(one, three, 1, progress);
  ASSERT_EQ(to_roof.size(), 1U);
  // A dense grid says how far it is at the worst.
  double worst = 0;
  for (int i = 0; i <= 400; ++i) {
    for (int j = 0; j <= 400 - i; ++j) {
      const double a = i / 400.0;
      const double b = j / 400.0;
      worst = std::max(worst, three.nearest(a * flat[0] + b * flat[1] + (1 - a - b) * flat[2]).distance_mm);
    }
  }
  EXPECT_GT(worst, 0.5);
  EXPECT_GE(to_roof[0].upper_mm, worst);
  EXPECT_LT(to_roof[0].upper_mm, 1.1 * worst);
  EXPECT_LE(to_roof[0].lower_mm, to_roof[0].upper_mm);
  const auto to_flat = surface_distances(three, one, 1, progress);
  for (const TriangleDistance& d : to_flat) {
    EXPECT_GE(d.upper_mm, 1);
    EXPECT_LT(d.upper_mm, 1.06);
    EXPECT_NEAR(d.lower_mm, 1, 1e-12);
  }
}

TEST(SurfaceDistances, NoSampleIsFartherThanTheBound) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto soup = [&](std::vector<Point>& points) {
    std::vector<Triangle> triangles;
    for (VertexId t = 0; t < 20; ++t) {
      const Point at{4 * any(random), 4 * any(random), 4 * any(random)};
      for (int n = 0; n < 3; ++n) points.push_back(at + Vec{any(random), any(random), any(random)});
      triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    return triangles;
  };
  std::vector<Point> a;
  std::vector<Point> b;
  const auto of_a = soup(a);
  const auto of_b = soup(b);
  const TriangleSet from(a, of_a);
  const TriangleSet to(b, of_b);
  Progress progress;
  const auto found = surface_distances(from, to, 0.5, progress);
  for (std::size_t t = 0; t < from.count(); ++t) {
    const auto corners = from.corners(t);
    for (int n = 0; n < 300; ++n) {
      double u = 0.5 * (any(random) + 1);
      double v = 0.5 * (any(random) + 1);
      if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
      }
      const Point p = u * corners[0] + v * corners[1] + (1 - u - v) * corners[2];
      EXPECT_LE(to.nearest(p).distance_mm, found[t].upper_mm);
    }
    EXPECT_LE(to.nearest(found[t].lower_place).distance_mm, found[t].lower_mm + 1e-14);
  }
}

}  // namespace
}  // namespace scantet::verify
