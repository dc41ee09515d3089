#include "scantet/field/bernstein_cubic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace scantet {
namespace {

/// scale · (t - r0)(t - r1)(t - r2) in Bernstein form: the coefficients are values of its polar form.
BernsteinCubic with_roots(double r0, double r1, double r2, double scale = 1) {
  const auto polar = [&](double a, double b, double c) {
    const auto term = [&](double x, double y, double z) { return (x - r0) * (y - r1) * (z - r2); };
    return scale * (term(a, b, c) + term(a, c, b) + term(b, a, c) + term(b, c, a) + term(c, a, b) + term(c, b, a)) / 6;
  };
  return {polar(0, 0, 0), polar(0, 0, 1), polar(0, 1, 1), polar(1, 1, 1)};
}

std::vector<double> changes_of(const BernsteinCubic& b) {
  const SignChanges changes = sign_changes(b, b[0] > 0, b[3] > 0);
  return {changes.t.begin(), changes.t.begin() + changes.count};
}

void expect_roots(const BernsteinCubic& b, const std::vector<double>& expected, double tolerance) {
  const std::vector<double> found = changes_of(b);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], tolerance);
}

TEST(BernsteinCubic, ValueInterpolatesTheEndsAndKeepsTheSign) {
  const BernsteinCubic b{1e-30, 5, 1e-300, 3};
  EXPECT_EQ(value_at(b, 0), b[0]);
  EXPECT_EQ(value_at(b, 1), b[3]);
  for (double t = 0; t <= 1; t += 1.0 / 64) EXPECT_GT(value_at(b, t), 0);
  EXPECT_DOUBLE_EQ(value_at({0, 0, 0, 8}, 0.5), 1);
}

TEST(BernsteinCubic, NoRoot) {
  expect_roots({1, 2, 0.5, 1}, {}, 0);
  expect_roots({-1, -2, -0.5, -1}, {}, 0);
  expect_roots({1, -0.2, -0.2, 1}, {}, 0);  // the coefficients change sign, the cubic does not
  expect_roots(with_roots(-0.5, 1.5, 2), {}, 0);
  expect_roots({0, 0, 0, 0}, {}, 0);
}

TEST(BernsteinCubic, OneTwoAndThreeRoots) {
  expect_roots(with_roots(0.3, 2, 3), {0.3}, 1e-15);
  expect_roots(with_roots(0.3, -2, 3, -7), {0.3}, 1e-15);
  expect_roots(with_roots(0.2, 0.7, 5), {0.2, 0.7}, 1e-15);
  expect_roots(with_roots(0.1, 0.55, 0.8), {0.1, 0.55, 0.8}, 1e-14);
  expect_roots(with_roots(0.1, 0.55, 0.8, -1e200), {0.1, 0.55, 0.8}, 1e-14);
  expect_roots(with_roots(0.1, 0.55, 0.8, 1e-200), {0.1, 0.55, 0.8}, 1e-14);
  expect_roots({-1, -1.0 / 3, 1.0 / 3, 1}, {0.5}, 1e-16);  // a line
}

TEST(BernsteinCubic, RootsAtTheEnds) {
  expect_roots(with_roots(0, 2, 3), {0}, 0);      // from a zero, which counts as ≤ 0, to > 0
  expect_roots(with_roots(0, 2, 3, -1), {}, 0);   // from a zero to < 0
  expect_roots(with_roots(1, 2, 3, -1), {1}, 0);  // > 0 up to a zero at the end
  expect_roots(with_roots(1, 2, 3), {}, 0);
  expect_roots(with_roots(0, 0.5, 1), {0, 0.5}, 1e-15);  // 0 | + | - 0
  expect_roots({0, 0, 0, 1}, {0}, 0);
}

TEST(BernsteinCubic, DoubleRootIsNoChange) {
  expect_roots(with_roots(0.5, 0.5, 3), {}, 0);
  expect_roots(with_roots(0.5, 0.5, -3), {}, 0);
  expect_roots(with_roots(0.3, 0.3, 0.8), {0.8}, 1e-15);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.01, 0.99);
  for (int i = 0; i < 2000; ++i) {
    const double r = unit(random);
    EXPECT_TRUE(changes_of(with_roots(r, r, 1.5)).empty()) << r;
    EXPECT_TRUE(changes_of(with_roots(r, r, -0.5)).empty()) << r;
  }
}

TEST(BernsteinCubic, TripleRootIsOneChange) {
  for (const double r : {0.0625, 0.25, 0.5, 0.75, 1.0 / 3}) {
    const std::vector<double> found = changes_of(with_roots(r, r, r));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0], r, 1e-5);  // a rounding of 1e-16 moves a triple root by its cube root
  }
}

TEST(BernsteinCubic, CloseRootsAreToldApart) {
  for (const double gap : {1e-2, 1e-4, 1e-6}) {
    expect_roots(with_roots(0.4, 0.4 + gap, 0.9), {0.4, 0.4 + gap, 0.9}, 1e-14 / gap);
    expect_roots(with_roots(0.4, 0.4 + gap, 1.9), {0.4, 0.4 + gap}, 1e-14 / gap);
  }
}

TEST(BernsteinCubic, TheGivenSignsOverruleRounding) {
  const BernsteinCubic above{1e-17, 0.2, 0.3, 0.4};
  SignChanges changes = sign_changes(above, false, true);
  ASSERT_EQ(changes.count, 1);
  EXPECT_EQ(changes.t[0], 0);
  changes = sign_changes(above, true, false);
  ASSERT_EQ(changes.count, 1);  // an odd count whatever the values say, at the smaller of the two ends
  EXPECT_EQ(changes.t[0], 0);
  EXPECT_EQ(sign_changes({0.4, 0.3, 0.2, -1e-17}, true, true).count, 0);
  changes = sign_changes({0.4, 0.3, 0.2, 1e-17}, true, false);
  ASSERT_EQ(changes.count, 1);
  EXPECT_EQ(changes.t[0], 1);
  EXPECT_EQ(sign_changes({0, 0, 0, 0}, true, false).count, 1);
  EXPECT_TRUE(positive_before_end({-1, -1, 1, 0}, false));
  EXPECT_FALSE(positive_before_end({1, -1, 0, 0}, true));
  EXPECT_TRUE(positive_before_end({0, 0, 0, 0}, true));
}

TEST(BernsteinCubic, RandomCubicsAgreeWithSampling) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> coefficient(-1, 1);
  for (int i = 0; i < 20000; ++i) {
    BernsteinCubic b;
    for (double& value : b) value = coefficient(random);
    if (i % 3 == 0) b[0] *= 1e-9;
    if (i % 5 == 0) b[2] = b[1] + 1e-12 * b[2];
    const std::vector<double> found = changes_of(b);
    ASSERT_TRUE(std::is_sorted(found.begin(), found.end()));
    for (const double t : found) {
      ASSERT_GE(t, 0);
      ASSERT_LE(t, 1);
      ASSERT_LE(std::abs(value_at(b, t)), 1e-15);
    }
    for (int sample = 0; sample <= 100; ++sample) {
      const double t = sample / 100.0;
      const auto before = std::count_if(found.begin(), found.end(), [t](double root) { return root < t; });
      if (std::abs(value_at(b, t)) < 1e-14) continue;
      ASSERT_EQ(value_at(b, t) > 0, (b[0] > 0) == (before % 2 == 0)) << "cubic " << i << " at " << t;
    }
  }
}

}  // namespace
}  // namespace scantet
