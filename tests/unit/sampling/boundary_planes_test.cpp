#include <gtest/gtest.h>

#include "scantet/domain/analytic.h"
#include "scantet/sampling/boundary_planes_impl.h"
#include "scantet/sampling/initial_sample.h"
#include "unit/nested_balls.h"

namespace scantet::engine {
namespace {

constexpr double kSize_mm = 0.8;

std::vector<Point> sample_of(const Domain& domain) {
  Progress progress;
  return initial_sample(domain, UniformSize(kSize_mm), {}, progress);
}

TEST(BoundaryPlanes, AreTangentAndKnowTheInside) {
  const auto shell = make_shell({}, 4, 7);
  const std::vector<Point> sample = sample_of(*shell);
  const UniformSize size(kSize_mm);
  const BoundaryPlanes planes(*shell, size, 1, sample);
  EXPECT_EQ(planes.points().entries().size(), sample.size());
  for (std::uint32_t i = 0; i < sample.size(); ++i) {
    ASSERT_TRUE(planes.has_plane(i));
    const Vec outward = (1 / length(sample[i])) * (sample[i] - Point{});
    const double sign = length(sample[i]) > 5.5 ? -1 : 1;  // on the inner sphere the shell is outward
    EXPECT_GT(sign * dot(planes.inward(i), outward), 0.97);
    EXPECT_NEAR(length(planes.inward(i)), 1, 1e-9);
    EXPECT_FALSE(planes.is_interface(i));
  }
}

TEST(BoundaryPlanes, KnowInterfaces) {
  const test::NestedBalls balls(4, 7);
  const std::vector<Point> sample = sample_of(balls);
  const UniformSize size(kSize_mm);
  const BoundaryPlanes planes(balls, size, 1, sample);
  for (std::uint32_t i = 0; i < sample.size(); ++i) {
    ASSERT_TRUE(planes.has_plane(i));
    EXPECT_EQ(planes.is_interface(i), length(sample[i]) < 5.5);
  }
}

TEST(BoundaryPlanes, ThereIsNoneWherePointsAreFewOrBothSidesAreAlike) {
  const auto sphere = make_sphere({}, 7);
  const UniformSize size(kSize_mm);
  const BoundaryPlanes alone(*sphere, size, 1, {{7, 0, 0}, {-7, 0, 0}, {0, 7, 0}});
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_FALSE(alone.has_plane(i));
  std::vector<Point> inside;  // a plane, but not of the boundary
  for (int i = 0; i < 100; ++i) inside.push_back({0.4 * (i % 10) - 2, 0.4 * (i / 10) - 2, 0.3});
  const BoundaryPlanes wrong(*sphere, size, 1, inside);
  for (std::uint32_t i = 0; i < inside.size(); ++i) EXPECT_FALSE(wrong.has_plane(i));
}

TEST(BoundaryPlanes, FollowTheSizeWhereItVaries) {
  // Two flat rows of points, 1 mm apart: a reach of 0.8 mm sees one of them, a reach of 2.4 mm both.
  const auto sphere = make_sphere({0, 0, -100}, 100);
  std::vector<Point> sample;
  for (int i = 0; i < 400; ++i) {
    const double x = 0.25 * (i % 20) - 2.5;
    const double y = 0.25 * (i / 20) - 2.5;
    const double z = std::sqrt(100 * 100 - x * x - y * y) - 100;
    sample.push_back({x, y, z});
    sample.push_back({x, y, z - 1});
  }
  const UniformSize fine(0.5);
  const UniformSize coarse(1.5);
  const BoundaryPlanes near(*sphere, fine, 1, sample);
  const BoundaryPlanes far(*sphere, coarse, 1, sample);
  const std::uint32_t middle = 2 * 210;
  ASSERT_TRUE(near.has_plane(middle));
  EXPECT_LT(near.inward(middle).z, -0.99);
  EXPECT_FALSE(far.has_plane(middle) && far.inward(middle).z < -0.9999) << "the other row counts, too";
}

}  // namespace
}  // namespace scantet::engine
