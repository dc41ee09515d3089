#include "scantet/sampling/bulk_seeds.h"

#include <gtest/gtest.h>

#include "cancelled_after.h"
#include "scantet/base/parallel.h"
#include "scantet/domain/analytic.h"
#include "scantet/sampling/initial_sample.h"
#include "unit/cut_balls.h"
#include "unit/nested_balls.h"
#include "unit/sampling/distance_to.h"

namespace scantet {
namespace {

using test::distance_to;

/// Grows away from a point on the x axis; 1-Lipschitz.
class GradedSize final : public SizingField {
 public:
  double size_at(const Point& p) const override { return 0.5 + 0.2 * distance(p, {10, 0, 0}); }
  double min_size() const override { return 0.5; }
};

struct Sampled {
  std::vector<Point> boundary;
  std::vector<Point> seeds;
};

Sampled sampled(const Domain& domain, const SizingField& size, double alpha = 1) {
  Progress progress;
  Sampled result;
  result.boundary = initial_sample(domain, size, {alpha, 0}, progress);
  result.seeds = bulk_seeds(domain, size, result.boundary, {alpha}, progress);
  return result;
}

double closest_pair(const std::vector<Point>& points) {
  double closest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) closest = std::min(closest, distance(points[i], points[j]));
  }
  return closest;
}

TEST(BulkSeeds, AreInsideApartAndClearOfTheBoundary) {
  const auto torus = make_torus({}, 10, 4);
  for (const double alpha : {0.5, 1.0, 1.5}) {
    const Sampled points = sampled(*torus, UniformSize(1), alpha);
    ASSERT_GT(points.seeds.size(), 100U);
    for (const Point& p : points.seeds) {
      EXPECT_NE(torus->region_at(p), kOutside);
      EXPECT_GE(distance_to(points.boundary, p), 0.8 * std::max(1.0, alpha));
    }
    EXPECT_GE(closest_pair(points.seeds), 0.65);
  }
}

/// Between two regions there is a layer of seeds on either side, nearly as dense as if there were one region at a time.
TEST(BulkSeeds, AreOnBothSidesOfAnInterface) {
  const auto in_layer = [](const Domain& domain, double depth_mm) {
    const Sampled points = sampled(domain, UniformSize(1));
    EXPECT_GE(closest_pair(points.seeds), 0.65);
    int count = 0;
    for (const Point& p : points.seeds) {
      EXPECT_GE(distance_to(points.boundary, p), 0.8);
      count += std::abs(6 - length(p) - depth_mm) < 0.05 ? 1 : 0;
    }
    return count;
  };
  const test::NestedBalls balls(6, 12);
  EXPECT_GT(in_layer(balls, 0.9), 0.8 * in_layer(*make_sphere({}, 6), 0.9));
  EXPECT_GT(in_layer(balls, -0.9), 0.8 * in_layer(*make_shell({}, 6, 12), -0.9));
}

/// The layer beside one surface does not reach another that it meets.
TEST(BulkSeeds, KeepOffASurfaceThatMeetsAnother) {
  const test::CutBall ball(10, 2);
  for (double size = 1; size < 3; size += 0.05) {
    for (const Point& p : sampled(ball, UniformSize(size)).seeds) {
      EXPECT_GT(10 - length(p - Point{}), 0.15 * size) << "of the size " << size;
    }
  }
}

/// Balls of radius σ around all points cover the inside, but for a few places in the layer under the boundary.
TEST(BulkSeeds, CoverTheInside) {
  const auto sphere = make_sphere({}, 10);
  Sampled points = sampled(*sphere, UniformSize(2));
  points.seeds.insert(points.seeds.end(), points.boundary.begin(), points.boundary.end());
  int asked = 0;
  int uncovered = 0;
  for (double x = -10; x <= 10; x += 0.5) {
    for (double y = -10; y <= 10; y += 0.5) {
      for (double z = -10; z <= 10; z += 0.5) {
        const Point p{x, y, z};
        if (sphere->region_at(p) == kOutside) continue;
        const double nearest = distance_to(points.seeds, p);
        EXPECT_LE(nearest, 2.5);
        EXPECT_TRUE(nearest <= 2 || length(p) > 6);
        ++asked;
        uncovered += nearest > 2 ? 1 : 0;
      }
    }
  }
  EXPECT_LT(uncovered, asked / 100);
}

TEST(BulkSeeds, AreGradedWithTheSize) {
  const auto sphere = make_sphere({}, 10);
  const GradedSize size;
  const Sampled points = sampled(*sphere, size);
  ASSERT_GT(points.seeds.size(), 100U);
  std::vector<Point> all = points.seeds;
  all.insert(all.end(), points.boundary.begin(), points.boundary.end());
  int fine = 0;
  for (const Point& p : points.seeds) {
    // σ at the lattice point it comes from is within 20 % of σ(p), as that is at most σ away and σ grows by 0.2.
    EXPECT_GE(distance_to(points.boundary, p), 0.8 * 0.8 * size.size_at(p));
    fine += distance(p, {10, 0, 0}) < 5 ? 1 : 0;
  }
  EXPECT_GE(closest_pair(points.seeds), 0.54 * size.min_size());
  EXPECT_GT(fine, static_cast<int>(points.seeds.size()) / 3);  // in 5 % of the volume
  for (const double x : {-6.0, -3.0, 0.0, 3.0, 6.0})
    EXPECT_LE(distance_to(all, {x, 0, 0}), 1.5 * size.size_at({x, 0, 0}));
}

TEST(BulkSeeds, OfAThinShellAreNone) {
  EXPECT_TRUE(sampled(*make_shell({}, 9.5, 10), UniformSize(1)).seeds.empty());
}

TEST(BulkSeeds, DoNotDependOnThreads) {
  const auto torus = make_torus({}, 10, 4);
  std::vector<std::vector<Point>> seeds;
  for (const std::size_t threads : {1, 2, 8}) {
    with_threads(threads, [&] { seeds.push_back(sampled(*torus, UniformSize(0.6)).seeds); });
  }
  EXPECT_GT(seeds[0].size(), 2000U);
  EXPECT_EQ(seeds[0], seeds[1]);
  EXPECT_EQ(seeds[0], seeds[2]);
}

TEST(BulkSeeds, StopAtTheLimit) {
  Progress progress;
  const auto sphere = make_sphere({}, 10);
  const UniformSize size(0.25);
  const auto boundary = initial_sample(*sphere, size, {}, progress);
  const auto all = bulk_seeds(*sphere, size, boundary, {}, progress);
  const auto some = bulk_seeds(*sphere, size, boundary, {1, 1000}, progress);
  EXPECT_GE(some.size(), 1000U);
  EXPECT_LT(some.size(), all.size());
}

TEST(BulkSeeds, StopWhenCancelled) {
  Progress progress;
  test::CancelledAfter cancelled(0);
  const auto sphere = make_sphere({}, 10);
  const auto boundary = initial_sample(*sphere, UniformSize(1), {}, progress);
  EXPECT_TRUE(bulk_seeds(*sphere, UniformSize(1), boundary, {}, cancelled).empty());
}

}  // namespace
}  // namespace scantet
