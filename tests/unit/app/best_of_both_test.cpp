#include "scantet/app/best_of_both.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scantet/check/audit.h"
#include "scantet/domain/analytic.h"
#include "unit/quality/grid_mesh.h"

namespace scantet {
namespace {

constexpr int kGridSide = 12;
const Point kHere{2, 2, 2};
const Point kThere{10, 10, 10};

bool has(const Meshing& meshing, const Point& p) {
  const std::vector<Point>& vertices = meshing.refined.mesh.vertices;
  return std::find(vertices.begin(), vertices.end(), p) != vertices.end();
}

/// A grid with a bad element at each of the places, where a vertex is not where it should be.
Meshing wrong_at(const std::vector<Point>& places) {
  Meshing meshing;
  meshing.refined.mesh = test::grid_mesh(kGridSide);
  for (const Point& p : places) {
    auto& vertices = meshing.refined.mesh.vertices;
    std::find(vertices.begin(), vertices.end(), p)->x += 0.3;
    meshing.conformance.places.push_back(p);
    meshing.conformance.edges_mm.push_back(1);
  }
  return meshing;
}

std::optional<Meshing> best_of(const Meshing& one, const Meshing& other) {
  return best_of_both(one, other, *make_sphere({6, 6, 6}, 6), UniformSize(0.5));
}

TEST(BestOfBoth, EachPlaceIsFromTheMeshThatIsRightThere) {
  const std::optional<Meshing> both = best_of(wrong_at({kHere}), wrong_at({kThere}));
  ASSERT_TRUE(both);
  EXPECT_TRUE(has(*both, kHere));
  EXPECT_TRUE(has(*both, kThere));
  EXPECT_TRUE(audit(both->refined.mesh, nullptr, {}).passed());
}

TEST(BestOfBoth, NothingIsTakenFromWhereTheOtherIsWrongToo) {
  EXPECT_FALSE(best_of(wrong_at({kHere}), wrong_at({kHere, kThere})));
}

TEST(BestOfBoth, WhatIsKnownOfThePlaceComesWithIt) {
  Meshing one = wrong_at({kHere});
  Meshing other = wrong_at({kThere, kThere - Vec{1, 0, 0}});
  one.finer = {{kHere, 0.1}, {kThere, 0.2}};
  other.finer = {{kHere, 0.3}, {kThere, 0.4}};
  one.refined.exchanged_handles = {kHere, kThere};
  other.refined.wrong_handles = {kThere};
  const std::optional<Meshing> both = best_of(one, other);
  ASSERT_TRUE(both);
  ASSERT_EQ(both->finer.size(), 1U);
  EXPECT_EQ(both->finer[0].size_mm, 0.2) << "away from the place, where nothing has changed";
  EXPECT_EQ(both->refined.exchanged_handles, std::vector<Point>{kThere});
  EXPECT_EQ(both->refined.wrong_handles, std::vector<Point>{kThere}) << "wherever they are";
}

}  // namespace
}  // namespace scantet
