#include "scantet/surface/channel_search_impl.h"
#include "unit/solids.h"
#include "unit/surface/samples.h"

namespace scantet::engine {
namespace {

/// The facets of a piece of the inside that is not the main one.
std::vector<FacetCode> facets_of_piece(const RestrictedTriangulation& t) {
  std::vector<FacetCode> facets;
  Pieces pieces(t, BoundarySurfaces(t, BoundaryFacets(t, boundary_facets(t.triangulation()))));
  for (const FacetCode side : pieces.side_facets()) {
    if (t.triangulation().info(side / 4).region == kOutside) continue;
    if (facets.empty() || pieces.of(side / 4) == pieces.of(facets.front() / 4)) facets.push_back(side);
  }
  return facets;
}

/// What is found from that piece, in steps from first_mm to last_mm.
std::vector<SamplePoint> found(const Domain& domain, RestrictedTriangulation& t, double first_mm, double last_mm) {
  const std::vector<FacetCode> facets = facets_of_piece(t);
  EXPECT_FALSE(facets.empty()) << "the mesh is in one piece";
  if (facets.empty()) return {};
  Pieces pieces(t, BoundarySurfaces(t, BoundaryFacets(t, boundary_facets(t.triangulation()))));
  std::vector<Point> hints;
  domain.size_hints([&](const SizeHint& hint) { hints.push_back(hint.point); });
  return ChannelSearch(domain, t, pieces, hints).points(facets, first_mm, last_mm);
}

TEST(ChannelSearch, FindsPointsAroundTheNeckThatJoinsTwoPieces) {
  const test::Solids dumbbell = test::dumbbell(0.15);
  RestrictedTriangulation t = triangulated(dumbbell, without_neck(dumbbell));
  const std::vector<SamplePoint> points = found(dumbbell, t, 0.8, 0.05);
  ASSERT_GE(points.size(), 6U);
  std::size_t on_neck = 0;
  for (const SamplePoint& p : points) {
    EXPECT_EQ(p.dimension, 2);
    EXPECT_TRUE(dumbbell.patch_at(p.point).is_known()) << "on the boundary";
    on_neck += std::abs(std::hypot(p.point.y - 0.8, p.point.z - 0.6) - 0.15) < 1e-9 && std::abs(p.point.x) < 3 ? 1 : 0;
  }
  EXPECT_GT(on_neck, points.size() / 2);
  for (int round = 0; round < 10 && !facets_of_piece(t).empty(); ++round) {
    for (const SamplePoint& p : found(dumbbell, t, 0.8, 0.02)) insert(t, p.point);
  }
  EXPECT_TRUE(facets_of_piece(t).empty()) << "with such points the pieces become one";
}

TEST(ChannelSearch, FindsNothingWhereTheStepsAreTooLongOrThereIsNoChannel) {
  const test::Solids thin = test::dumbbell(0.02);
  RestrictedTriangulation t = triangulated(thin, without_neck(thin));
  EXPECT_TRUE(found(thin, t, 0.8, 0.4).empty());
  const test::Solids apart{{{{-5, 0, 0}, 3.1}, {{5, 0.3, 0.2}, 2.9}}, {}};
  RestrictedTriangulation two = triangulated(apart, without_neck(apart));
  EXPECT_TRUE(found(apart, two, 0.8, 0.2).empty());
}

}  // namespace
}  // namespace scantet::engine
