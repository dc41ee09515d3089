#include <gtest/gtest.h>

#include <random>

#include "scantet/delaunay/partition_impl.h"

namespace scantet::engine {
namespace {

std::vector<Point> points_in(const Vec& extent, std::size_t count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Point> points(count);
  for (Point& p : points) p = {extent.x * unit(random), extent.y * unit(random), extent.z * unit(random)};
  return points;
}

TEST(Partition, SharesTheWorkOut) {
  const std::vector<Point> points = points_in({10, 20, 30}, 40'000);
  std::vector<Point> work = points;
  const Partition partition(work, 3, 0.5);
  ASSERT_EQ(partition.count(), 8);
  std::vector<std::size_t> counts(8, 0);
  for (const Point& p : points) ++counts[partition.of(p)];
  for (const std::size_t count : counts) EXPECT_NEAR(double(count), 5000, 2500);
}

TEST(Partition, CutsAcrossASlabAndNotAlongIt) {
  const std::vector<Point> points = points_in({0.2, 10, 10}, 10'000);  // what an earlier cut across x left over
  std::vector<Point> work = points;
  const Partition partition(work, 1, 0.5);
  std::size_t near = 0;
  for (const Point& p : points) {
    if (partition.of(p) != partition.of(p + Vec{0, 0.3, 0}) || partition.of(p) != partition.of(p + Vec{0, 0, 0.3}))
      ++near;
    EXPECT_EQ(partition.of(p), partition.of({0.1, p.y, p.z}));
  }
  EXPECT_LT(near, points.size() / 10);
}

TEST(Partition, OfOnePlaceIsValid) {
  std::vector<Point> work(100, Point{1, 2, 3});
  const Partition partition(work, 2, 1);
  EXPECT_LT(partition.of({1, 2, 3}), 4);
  EXPECT_LT(partition.of({-100, 200, 3}), 4);
}

TEST(Partition, DepthGivesEachPartItsLeast) {
  EXPECT_EQ(partition_depth(999, 1000), 0);
  EXPECT_EQ(partition_depth(1999, 1000), 0);
  EXPECT_EQ(partition_depth(2000, 1000), 1);
  EXPECT_EQ(partition_depth(4000, 1000), 2);
  EXPECT_EQ(partition_depth(1'000'000'000, 1000), Partition::kMostCuts);
}

}  // namespace
}  // namespace scantet::engine
