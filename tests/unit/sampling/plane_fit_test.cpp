#include <gtest/gtest.h>

#include <random>

#include "scantet/sampling/plane_fit_impl.h"

namespace scantet::engine {
namespace {

/// Random points of a box of these half widths along three axes, a and b and the cross product of the two.
PlaneFit fit_of(const Vec& a, const Vec& b, const Vec& half_widths, int count) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  PlaneFit fit;
  for (int i = 0; i < count; ++i) {
    const double u = half_widths.x * unit(random);
    const double v = half_widths.y * unit(random);
    fit.add(u * a + v * b + half_widths.z * unit(random) * cross(a, b), 1 + 0.5 * unit(random));
  }
  return fit;
}

const Vec kA{0.6, 0.8, 0};
const Vec kB{-0.48, 0.36, 0.8};

TEST(PlaneFit, FindsTheNormal) {
  const auto normal = fit_of(kA, kB, {2, 1, 0}, 10).normal();
  ASSERT_TRUE(normal.has_value());
  EXPECT_NEAR(std::abs(dot(*normal, cross(kA, kB))), 1, 1e-9);
  const auto rough = fit_of(kA, kB, {2, 2, 0.3}, 20).normal();
  ASSERT_TRUE(rough.has_value());
  EXPECT_GT(std::abs(dot(*rough, cross(kA, kB))), 0.97);
  EXPECT_NEAR(length(*rough), 1, 1e-12);
}

TEST(PlaneFit, FindsNoneWhereThereIsNone) {
  EXPECT_FALSE(PlaneFit().normal().has_value());
  EXPECT_FALSE(fit_of(kA, kB, {1, 1, 0}, 3).normal().has_value());
  EXPECT_FALSE(fit_of(kA, kB, {1, 0, 0}, 20).normal().has_value());
  EXPECT_FALSE(fit_of(kA, kB, {1, 1, 1}, 200).normal().has_value());
  EXPECT_FALSE(fit_of(kA, kB, {0, 0, 0}, 20).normal().has_value());
}

}  // namespace
}  // namespace scantet::engine
