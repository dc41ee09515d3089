// Facets that are kept up to date are those that a look at all cells tells.
#include <algorithm>
#include <random>

#include "scantet/domain/analytic.h"
#include "scantet/surface/boundary_facets_impl.h"
#include "unit/nested_balls.h"
#include "unit/surface/samples.h"

namespace scantet::engine {
namespace {

TEST(BoundaryFacets, AreSeenOnceFromTheSmallerRegionThatIsNotOutside) {
  const test::NestedBalls balls(3, 6);
  const RestrictedTriangulation restricted = triangulated(balls, sparse_sample(balls, 1, 2));
  const Triangulation& t = restricted.triangulation();
  std::vector<FacetCode> expected;
  std::size_t interfaces = 0;
  for_each_inner_facet(t, [&](FacetCode facet) {
    const FacetCode across = t.cell(facet / 4).neighbor[facet % 4];
    const Region here = t.info(facet / 4).region;
    const Region there = t.info(across / 4).region;
    if (here == there) return;
    interfaces += here != kOutside && there != kOutside ? 1 : 0;
    expected.push_back(there == kOutside || (here != kOutside && here < there) ? facet : across);
  });
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(boundary_facets(t), expected);
  EXPECT_GT(interfaces, 20U);
  EXPECT_GT(expected.size(), interfaces);
}

/// Facets in the order of their codes.
BoundaryFacets sorted(const RestrictedTriangulation& t, const BoundaryFacets& facets) {
  std::vector<FacetCode> codes = facets.codes;
  std::sort(codes.begin(), codes.end());
  BoundaryFacets fresh(t, codes);
  for (std::size_t n = 0; n < facets.codes.size(); ++n) {
    const auto place = std::lower_bound(codes.begin(), codes.end(), facets.codes[n]) - codes.begin();
    EXPECT_EQ(fresh.corners[place], facets.corners[n]);
    EXPECT_EQ(fresh.patches[place], facets.patches[n]);
    EXPECT_EQ(fresh.is_inner[place], facets.is_inner[n]);
  }
  return fresh;
}

void expect_as_seen(const RestrictedTriangulation& t, const BoundaryFacets& facets) {
  ASSERT_EQ(facets.codes.size(), facets.corners.size());
  ASSERT_EQ(facets.codes.size(), facets.patches.size());
  ASSERT_EQ(facets.codes.size(), facets.is_inner.size());
  EXPECT_EQ(sorted(t, facets).codes, boundary_facets(t.triangulation()));
}

TEST(BoundaryFacets, AreUpToDateWherePointsWereInserted) {
  const auto torus = make_torus({}, 5, 2);
  RestrictedTriangulation t = triangulated(*torus, sparse_sample(*torus, 0.8, 3));
  EXPECT_EQ(t.take_changed().size(), t.vertex_count()) << "nothing is known yet";
  t.take_questions();
  EXPECT_EQ(t.take_changed().size(), t.vertex_count()) << "a vertex in question may be told of twice";
  EXPECT_TRUE(t.take_changed().empty());
  BoundaryFacets facets(t, boundary_facets(t.triangulation()));
  expect_as_seen(t, facets);
  for (int round = 0; round < 30; ++round) {
    const SurfaceBall& ball = t.balls()[t.triangulation().info(facets.codes[round] / 4).balls[facets.codes[round] % 4]];
    insert(t, Point(ball.center));
    if (round % 3 == 0) t.take_questions();  // whether a disk was asked for makes no difference
    const std::vector<PointId> changed = t.take_changed();
    EXPECT_GT(changed.size(), 3U);
    EXPECT_TRUE(std::is_sorted(changed.begin(), changed.end()));
    facets.update(t, changed);
    expect_as_seen(t, facets);
  }
}

TEST(BoundaryFacets, AreUpToDateWhereTetsChangedSides) {
  const test::NestedBalls balls(3, 6);
  RestrictedTriangulation t = triangulated(balls, sparse_sample(balls, 1, 2));
  t.take_changed();
  BoundaryFacets facets(t, boundary_facets(t.triangulation()));
  std::mt19937 random(1);
  std::size_t least = facets.codes.size();
  std::size_t most = least;
  for (int round = 0; round < 30; ++round) {
    for (int n = 0; n < 5; ++n) {
      const CellId c = facets.codes[random() % facets.codes.size()] / 4;
      t.change_side(c, (t.triangulation().info(c).region + 1) % 3);
    }
    facets.update(t, t.take_changed());
    expect_as_seen(t, facets);
    least = std::min(least, facets.codes.size());
    most = std::max(most, facets.codes.size());
  }
  EXPECT_LT(least, most);
}

TEST(BoundaryFacets, AreNoneWhereAllIsOutside) {
  const auto sphere = make_sphere({}, 5);
  RestrictedTriangulation t = triangulated(*sphere, sparse_sample(*sphere, 2, 1));
  BoundaryFacets facets(t, boundary_facets(t.triangulation()));
  ASSERT_FALSE(facets.codes.empty());
  for (CellId c = 0; c < t.triangulation().cell_slots(); ++c) {
    if (t.triangulation().is_cell(c) && t.triangulation().info(c).region != kOutside) t.change_side(c, kOutside);
  }
  facets.update(t, t.take_changed());
  EXPECT_TRUE(facets.codes.empty() && facets.corners.empty() && facets.patches.empty());
}

}  // namespace
}  // namespace scantet::engine
