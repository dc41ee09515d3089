#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "scantet/sampling/hinted_spacing_impl.h"

namespace scantet {
namespace {

TEST(HintedSpacing, IsAShareOfTheFeatureSizeNearHintsAndNowhereMore) {
  const HintedSpacing spacing({{{0, 0, 0}, 1}, {{10, 0, 0}, 3}}, 0.5, 2);
  EXPECT_DOUBLE_EQ(spacing.at({0, 0, 0}, 2), 0.5);
  EXPECT_DOUBLE_EQ(spacing.at({0, 2, 0}, 2), 1.5);   // 1 mm and the way of 2 mm
  EXPECT_DOUBLE_EQ(spacing.at({10, 0, 0}, 2), 1.5);  // the hint there
  EXPECT_DOUBLE_EQ(spacing.at({10, 0, 0}, 1), 1);    // finer than the hint asks for
  EXPECT_DOUBLE_EQ(spacing.at({0, 50, 0}, 2), 2);
  EXPECT_EQ(spacing.hints().size(), 2U);
}

// It looks farther and farther; all hints are looked at here.
TEST(HintedSpacing, IsTheLeastThatAnyHintAsksFor) {
  constexpr double kShare = 0.5;
  constexpr double kWidest_mm = 6;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-10, 10);
  for (const Vec& spread : {Vec{1, 1, 1}, Vec{1, 1, 0}, Vec{0.01, 0.01, 0.01}, Vec{0, 0, 0}}) {
    std::vector<SizeHint> hints;
    for (int n = 0; n < 1000; ++n) {
      const Point p{spread.x * place(random), spread.y * place(random), spread.z * place(random)};
      hints.push_back({p, 0.2 + 0.1 * std::abs(place(random))});
    }
    const HintedSpacing spacing(hints, kShare, kWidest_mm);
    for (int n = 0; n < 500; ++n) {
      const Point p{2 * place(random), 2 * place(random), place(random)};
      const double asked_mm = 0.05 * std::abs(place(random)) * kWidest_mm;
      double least = asked_mm;
      for (const SizeHint& hint : hints) {
        least = std::min(least, kShare * (hint.radius_mm + std::sqrt(squared_distance(p, hint.point))));
      }
      EXPECT_EQ(spacing.at(p, asked_mm), least);
    }
  }
}

TEST(HintedSpacing, WithoutHintsIsWhatItIsElsewhere) {
  EXPECT_DOUBLE_EQ(HintedSpacing().at({1, 2, 3}, 2), 2);
}

}  // namespace
}  // namespace scantet
