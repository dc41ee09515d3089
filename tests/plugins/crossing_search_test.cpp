// Crossings whose places are known, and the segments that are hard: tangent, at a kink, within the surface.
#include "crossing_search.h"

#include <gtest/gtest.h>

namespace implicit {
namespace {

using scantet::Crossings;
using scantet::Segment;

Crossings crossings_of(const std::string& text, const Segment& segment) {
  const Formula formula(text);
  scantet::Box box;
  for (const scantet::Point& p : {segment.source, segment.target}) {
    box.extend(p - scantet::Vec{0.5, 0.5, 0.5});
    box.extend(p + scantet::Vec{0.5, 0.5, 0.5});
  }
  Crossings crossings;
  find_crossings(formula, FormulaGrid(formula, box), segment, crossings);
  return crossings;
}

/// The x of each crossing of the segment on the x axis from `from` to `to`.
std::vector<double> crossings_on_axis(const std::string& formula, double from, double to) {
  std::vector<double> places;
  for (const auto& crossing : crossings_of(formula, {{from, 0, 0}, {to, 0, 0}})) places.push_back(crossing.point.x);
  return places;
}

void expect_places(const std::string& formula, double from, double to, const std::vector<double>& expected) {
  const std::vector<double> found = crossings_on_axis(formula, from, to);
  ASSERT_EQ(found.size(), expected.size()) << formula;
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-14 * std::abs(to - from)) << formula;
}

TEST(CrossingSearch, PlacesAreExactToTheLastDigits) {
  expect_places("x^2 - 2", -4, 4, {-std::sqrt(2), std::sqrt(2)});
  expect_places("exp(x) - 3", -1, 3, {std::log(3)});
  expect_places("abs(x) - 0.7", 3, -1, {0.7, -0.7});
  expect_places("max(x - 1, -x - 2)", -5, 5, {-2, 1});
}

TEST(CrossingSearch, ManyCrossingsOnOneSegment) {
  std::vector<double> expected;
  for (int k = -300; k <= 300; ++k) expected.push_back(k * 0.01 * std::numbers::pi);
  const std::vector<double> found = crossings_on_axis("sin(100*x)", -9.44, 9.44);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-13);
}

TEST(CrossingSearch, PairsThatAreNearEachOther) {
  for (const double gap : {1e-3, 1e-5, 1e-6}) {
    const std::string squared = std::to_string(gap * gap * 1e12) + "e-12";
    EXPECT_EQ(crossings_on_axis("(x - 0.3)^2 - " + squared, -1, 1).size(), 2u) << gap;
  }
}

TEST(CrossingSearch, TouchingIsNotCrossing) {
  EXPECT_TRUE(crossings_on_axis("x^2", -1, 1).empty());
  EXPECT_TRUE(crossings_on_axis("(x - 0.25)^4", -1, 1).empty());
  EXPECT_TRUE(crossings_on_axis("x^2 + 1e-9", -1, 2).empty());
  EXPECT_TRUE(crossings_on_axis("y", -1, 1).empty()) << "a segment in the surface is outside, as its points are";
  EXPECT_TRUE(crossings_on_axis("abs(y)*sin(x)", -9, 9).empty());
}

TEST(CrossingSearch, RootsOfHighOrder) {
  ASSERT_EQ(crossings_on_axis("x^3", -1, 2).size(), 1u);
  EXPECT_NEAR(crossings_on_axis("x^3", -1, 2)[0], 0, 1e-9);
  ASSERT_EQ(crossings_on_axis("(x - 0.3)^7", -1, 2).size(), 1u);
  EXPECT_NEAR(crossings_on_axis("(x - 0.3)^7", -1, 2)[0], 0.3, 1e-2) << "(1e-16)^(1/7) is 5e-3";
}

TEST(CrossingSearch, AHardPlaceDoesNotHideTheOthers) {
  const std::vector<double> found = crossings_on_axis("(x - 0.3)^9 * (x - 0.9) * (x + 0.5) * abs(x)", -1, 2);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(found[0], -0.5, 1e-12);
  EXPECT_NEAR(found[2], 0.9, 1e-12);
}

TEST(CrossingSearch, TheEndsDecide) {
  const Crossings crossings = crossings_of("x", {{0, 0, 0}, {-1, 0, 0}});
  ASSERT_EQ(crossings.size(), 1u) << "0 is outside, and what follows is inside";
  EXPECT_EQ(crossings[0].from, scantet::kOutside);
  EXPECT_EQ(crossings[0].to, 1);
  EXPECT_TRUE(crossings_of("x", {{0, 0, 0}, {1, 0, 0}}).empty());
}

}  // namespace
}  // namespace implicit
