// Signs are exact where rounding would decide otherwise, and intervals hold what they must.
#include "scantet/verify/exact_sign.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scantet/verify/interval.h"

namespace scantet::verify {
namespace {

TEST(ExactSign, OrientationOfPointsInAPlaneAndOneUnitInTheLastPlaceBesideIt) {
  const Point a{0.1, 0.1, 0.1};
  const Point b{12.3, 0.7, 0.1};
  const Point c{3.3, 9.1, 0.1};
  Point d{5.5, 4.4, 0.1};
  EXPECT_EQ(orientation(a, b, c, d), 0);
  d.z = std::nextafter(0.1, 1);
  EXPECT_EQ(orientation(a, b, c, d), 1);
  EXPECT_EQ(orientation(b, a, c, d), -1);
  d.z = std::nextafter(0.1, 0);
  EXPECT_EQ(orientation(a, b, c, d), -1);
}

TEST(ExactSign, TurnsOfPointsOnALine) {
  const Point a{0, 0.5, 0.5};
  const Point b{0, 12, 12};
  EXPECT_EQ(orientation_yz(a, b, {0, 24, 24}), 0);
  EXPECT_EQ(orientation_yz(a, b, {0, 24, std::nextafter(24.0, 25.0)}), 1);
  EXPECT_EQ(orientation_yz(a, b, {0, 24, std::nextafter(24.0, 23.0)}), -1);
}

TEST(ExactSign, SaddleThatRoundsToZero) {
  // (2^-30 + 1)·(2^-30 - 1)... as whole numbers: 134217729² and 134217728·134217730 differ by one.
  EXPECT_EQ(sign_of_saddle(134217729, 134217729, 134217728, 134217730, 0), 1);
  EXPECT_EQ(sign_of_saddle(134217728, 134217730, 134217729, 134217729, 0), -1);
  EXPECT_EQ(sign_of_saddle(6, 10, 5, 12, 0), 0);
  EXPECT_EQ(sign_of_saddle(0.3 + 2, 0.7 + 2, 0.7 + 2, 0.3 + 2, 2), 0);
}

TEST(ExactSign, IntervalsHoldTheResult) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-3, 3);
  for (int n = 0; n < 100000; ++n) {
    const double a = any(random);
    const double b = any(random);
    const long double sum = static_cast<long double>(a) + b;
    const long double product = static_cast<long double>(a) * b;
    const Interval s = Interval(a) + b;
    const Interval p = Interval(a) * b;
    ASSERT_TRUE(s.lo <= sum && sum <= s.hi);
    ASSERT_TRUE(p.lo <= product && product <= p.hi);
    if (b == 0) continue;
    const long double ratio = static_cast<long double>(a) / b;
    const Interval q = quotient(a, b);
    ASSERT_TRUE(q.lo <= ratio && ratio <= q.hi);
  }
}

}  // namespace
}  // namespace scantet::verify
