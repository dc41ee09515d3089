#include "scantet/domain/nearest_crossing.h"

#include <gtest/gtest.h>

namespace scantet {
namespace {

Crossing crossing_at(const Point& p, Region from, Region to) {
  Crossing crossing;
  crossing.point = p;
  crossing.from = from;
  crossing.to = to;
  return crossing;
}

TEST(NearestCrossing, IsTheFirstOfThoseThatAreNearest) {
  const Crossings crossings{crossing_at({3, 0, 0}, 0, 1), crossing_at({0, 2, 0}, 1, 2), crossing_at({0, 0, 2}, 2, 1)};
  EXPECT_EQ(nearest_crossing(crossings, {}), &crossings[1]);
  EXPECT_EQ(nearest_crossing(crossings, {3, 0, 0}), &crossings[0]);
  EXPECT_EQ(nearest_crossing({}, {}), nullptr);
}

TEST(NearestCrossing, IsOneThatCounts) {
  const Crossings crossings{crossing_at({3, 0, 0}, 0, 1), crossing_at({0, 2, 0}, 1, 2)};
  EXPECT_EQ(nearest_crossing(crossings, {}, [](const Crossing& c) { return c.from == 0; }), &crossings[0]);
  EXPECT_EQ(nearest_crossing(crossings, {}, [](const Crossing& c) { return c.from == 5; }), nullptr);
}

}  // namespace
}  // namespace scantet
