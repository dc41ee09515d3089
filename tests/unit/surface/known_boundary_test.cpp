// What is told of a boundary is what a look at it would tell, whatever has happened since the last one.
#include <gtest/gtest.h>

#include <algorithm>

#include "scantet/domain/analytic.h"
#include "scantet/surface/known_boundary_impl.h"
#include "unit/surface/samples.h"

namespace scantet::engine {
namespace {

std::vector<FacetCode> sorted(std::vector<FacetCode> facets) {
  std::sort(facets.begin(), facets.end());
  return facets;
}

class KnownBoundaryTest : public testing::Test {
 protected:
  void expect_as_seen() {
    const std::vector<FacetCode> expected = boundary_facets(triangulation_.triangulation());
    EXPECT_EQ(sorted(boundary_.facets().codes), expected);
    const BoundaryFacets all(triangulation_, expected);
    const BoundarySurfaces fresh(triangulation_, all);
    EXPECT_EQ(boundary_.surfaces().euler_number(), fresh.euler_number());
    EXPECT_EQ(boundary_.surfaces().is_whole(), fresh.is_whole());
    EXPECT_EQ(boundary_.surfaces().surfaces().size(), fresh.surfaces().size());
  }
  /// A tet inside with a boundary facet.
  CellId tet_at_boundary() { return boundary_.facets().codes.front() / 4; }

  std::unique_ptr<Domain> torus_ = make_torus({}, 5, 2);
  RestrictedTriangulation triangulation_ = triangulated(*torus_, sparse_sample(*torus_, 0.8, 3));
  KnownBoundary boundary_{triangulation_};
};

TEST_F(KnownBoundaryTest, IsAsSeenWhenItsDisksAreKnown) {
  expect_as_seen();
  EXPECT_FALSE(boundary_.surfaces().is_whole());
  boundary_.update_disks();
  expect_as_seen();
}

TEST_F(KnownBoundaryTest, IsAsSeenWhenTetsHaveChangedSides) {
  boundary_.update_disks();
  const std::vector<FacetCode> before = sorted(boundary_.facets().codes);
  triangulation_.change_side(tet_at_boundary(), kOutside);
  EXPECT_NE(sorted(boundary_.facets().codes), before);
  expect_as_seen();
  boundary_.update_disks();
  expect_as_seen();
}

TEST_F(KnownBoundaryTest, IsAsSeenWhenPointsHaveBeenInserted) {
  boundary_.update_disks();
  const std::vector<FacetCode> before = sorted(boundary_.facets().codes);
  const std::uint32_t ball = triangulation_.triangulation().info(tet_at_boundary()).balls[before.front() % 4];
  ASSERT_NE(ball, kNone);
  Editor editor(triangulation_);
  editor.find_zone(triangulation_.balls()[ball].center, before.front() / 4);
  editor.insert({triangulation_.balls()[ball].center, 2});
  editor.retire();
  EXPECT_NE(sorted(boundary_.facets().codes), before);
  expect_as_seen();
}

TEST_F(KnownBoundaryTest, LooksOnceAtWhatHasNotChanged) {
  const BoundarySurfaces* const surfaces = &boundary_.surfaces();
  const FacetCode* const facets = boundary_.facets().codes.data();
  EXPECT_EQ(&boundary_.surfaces(), surfaces);
  EXPECT_EQ(boundary_.facets().codes.data(), facets);
}

}  // namespace
}  // namespace scantet::engine
