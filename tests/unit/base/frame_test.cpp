#include "scantet/base/frame.h"

#include <gtest/gtest.h>

#include <random>

#include "scantet/base/error.h"

namespace scantet {
namespace {

TEST(Frame, RoundTripsThroughShearAndFlips) {
  const Frame frame({Vec{-0.5, 0.1, 0}, Vec{0.2, 0.9, -0.3}, Vec{0, 0.4, 2}}, {-300, 150, 1200});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-200, 200);
  for (int i = 0; i < 1000; ++i) {
    const Vec index{unit(random), unit(random), unit(random)};
    const Vec back = frame.to_index(frame.to_world(index));
    EXPECT_NEAR(distance(back, index), 0, 1e-9);
  }
}

TEST(Frame, ReportsSpacingAndHandedness) {
  const Frame frame({Vec{-3, 0, 0}, Vec{0, 4, 0}, Vec{0, 0, 5}}, {});
  EXPECT_DOUBLE_EQ(frame.spacing_mm(0), 3);
  EXPECT_DOUBLE_EQ(frame.min_spacing_mm(), 3);
  EXPECT_DOUBLE_EQ(frame.determinant_mm3(), -60);
}

TEST(Frame, WorldBoxHoldsTheRotatedBox) {
  const Frame frame({Vec{0, 1, 0}, Vec{-2, 0, 0}, Vec{0, 0, 1}}, {10, 0, 0});
  const Box box = frame.world_box({-1, -1, -1}, {3, 4, 5});
  EXPECT_EQ(box.min, (Point{2, -1, -1}));
  EXPECT_EQ(box.max, (Point{12, 3, 5}));
}

TEST(Frame, IndexBoxHoldsTheWorldBox) {
  const Frame frame({Vec{0, 1, 0}, Vec{-2, 0, 0}, Vec{0, 0, 1}}, {10, 0, 0});
  const Box box = frame.index_box({{2, -1, -1}, {12, 3, 5}});
  EXPECT_EQ(box.min, (Point{-1, -1, -1}));
  EXPECT_EQ(box.max, (Point{3, 4, 5}));
}

TEST(Frame, RefusesAxesThatDoNotSpanSpace) {
  const auto code_of = [](const std::array<Vec, 3>& columns) -> std::string {
    try {
      Frame frame(columns, {});
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::input);
      return error.code();
    }
    return "";
  };
  EXPECT_EQ(code_of({Vec{1, 0, 0}, Vec{2, 0, 0}, Vec{0, 0, 1}}), "input.frame");
  EXPECT_EQ(code_of({Vec{0, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}}), "input.frame");
  EXPECT_EQ(code_of({Vec{std::numeric_limits<double>::quiet_NaN(), 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}}), "input.frame");
  EXPECT_EQ(code_of({Vec{2e-41, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}}), "input.frame");
  EXPECT_EQ(code_of({Vec{1e-8, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}}), "");
  EXPECT_EQ(code_of({Vec{1e-12, 0, 0}, Vec{0, 1e-12, 0}, Vec{0, 0, 1e-12}}), "");
}

}  // namespace
}  // namespace scantet
