#include <gtest/gtest.h>

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

TEST(HintedSpacing, WithoutHintsIsWhatItIsElsewhere) {
  EXPECT_DOUBLE_EQ(HintedSpacing().at({1, 2, 3}, 2), 2);
}

}  // namespace
}  // namespace scantet
