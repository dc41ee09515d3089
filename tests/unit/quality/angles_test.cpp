#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scantet/quality/angles_impl.h"

namespace scantet {
namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

TEST(Angles, AreThoseOfTheArcTangent) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> exponent(-12, 12);
  std::uniform_real_distribution<double> even(-1, 1);
  for (int round = 0; round < 100000; ++round) {
    std::array<double, 6> sines{};
    std::array<double, 6> cosines{};
    for (std::size_t i = 0; i < 6; ++i) {
      const bool is_plain = random() % 2 == 0;
      sines[i] = std::abs(even(random)) * (is_plain ? 1 : std::pow(10, exponent(random)));
      cosines[i] = even(random);
    }
    const std::array<double, 6> angles = angles_deg(sines, cosines);
    for (std::size_t i = 0; i < 6; ++i) {
      const double expected = kDegrees * std::atan2(sines[i], cosines[i]);
      ASSERT_NEAR(angles[i], expected, 4e-16 * expected) << sines[i] << ", " << cosines[i];
    }
  }
}

TEST(Angles, OfTheAxesAreExact) {
  const std::array<double, 6> angles = angles_deg({0, 0, 3, 1e200, 2, 2}, {5, -5, 0, -0.0, 2, -2});
  EXPECT_EQ(angles[0], 0);
  EXPECT_EQ(angles[1], 180);
  EXPECT_EQ(angles[2], 90);
  EXPECT_EQ(angles[3], 90);
  EXPECT_EQ(angles[4], 45);
  EXPECT_EQ(angles[5], 135);
  for (const double none : angles_deg({0, 0, 0, 0, 0, 0}, {0, -0.0, 0, 0, 0, 0})) EXPECT_EQ(none, 0);
}

}  // namespace
}  // namespace scantet
