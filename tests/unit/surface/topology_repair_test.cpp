#include <algorithm>
#include <set>

#include "scantet/domain/analytic.h"
#include "scantet/surface/boundary_link_impl.h"
#include "scantet/surface/topology_repair_impl.h"
#include "unit/counting_domain.h"
#include "unit/solids.h"
#include "unit/surface/samples.h"

namespace scantet::engine {
namespace {

/// Those that pinches ask for as long as any does, then the others.
std::vector<ExtraPoint> missing_points(TopologyRepair& repair) {
  std::vector<ExtraPoint> points = repair.points_at_pinches();
  return points.empty() ? repair.points_on_pieces() : points;
}

TEST(TopologyRepair, HasNothingToAddToASurfaceWellSampled) {
  const auto torus = make_torus({}, 5, 2);
  RestrictedTriangulation t = triangulated(*torus, sparse_sample(*torus, 0.7, 1));
  const UniformSize size(2);
  KnownBoundary boundary(t);
  TopologyRepair repair(*torus, t, boundary, size, 1);
  EXPECT_FALSE(repair.is_whole()) << "nobody has looked";
  EXPECT_TRUE(missing_points(repair).empty());
  EXPECT_TRUE(repair.is_whole());
}

TEST(TopologyRepair, PointsAtPinchesMakeTheSurfaceWhole) {
  const auto torus = make_torus({}, 5, 0.7);
  RestrictedTriangulation t = triangulated(*torus, sparse_sample(*torus, 0.6, 9));
  const UniformSize size(2);
  KnownBoundary boundary(t);
  TopologyRepair repair(*torus, t, boundary, size, 1);
  std::vector<ExtraPoint> points = missing_points(repair);
  EXPECT_FALSE(points.empty());
  for (int round = 0; round < 200 && !points.empty(); ++round) {
    EXPECT_FALSE(repair.is_whole());
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_TRUE(torus->patch_at(points[i].point).is_known()) << "on the boundary";
      EXPECT_GT(points[i].clear_mm, 0);
      EXPECT_TRUE(i == 0 || points[i].clear_mm <= points[i - 1].clear_mm) << "the clearest first";
    }
    insert(t, points.front().point);
    points = missing_points(repair);
  }
  EXPECT_TRUE(points.empty());
  EXPECT_TRUE(repair.is_whole());
}

TEST(TopologyRepair, PointsAtPinchesAreTheCentresOfTheLargestBallsAround) {
  const auto torus = make_torus({}, 5, 0.7);
  RestrictedTriangulation restricted = triangulated(*torus, sparse_sample(*torus, 0.6, 9));
  Triangulation& t = restricted.triangulation();
  std::set<std::array<double, 3>> expected;
  for (const PointId v : check_all_disks(t, restricted.disks(), [&] { return boundary_facets(t); })) {
    SurfaceBall largest;
    for_each_inner_facet(t, [&](FacetCode facet) {
      const auto vertices = facet_vertices(t.cell(facet / 4), static_cast<int>(facet % 4));
      if (std::find(vertices.begin(), vertices.end(), v) == vertices.end()) return;
      for (std::uint32_t b = t.info(facet / 4).balls[facet % 4]; b != kNone; b = restricted.balls()[b].next) {
        if (restricted.balls()[b].radius > largest.radius) largest = restricted.balls()[b];
      }
    });
    if (largest.radius > 0.2) expected.insert({largest.center.x, largest.center.y, largest.center.z});
  }
  const UniformSize size(2);
  std::set<std::array<double, 3>> found;
  KnownBoundary boundary(restricted);
  for (const ExtraPoint& p : TopologyRepair(*torus, restricted, boundary, size, 1).points_at_pinches()) {
    found.insert({p.point.x, p.point.y, p.point.z});
  }
  EXPECT_GT(found.size(), 5U);
  EXPECT_EQ(found, expected);
}

TEST(TopologyRepair, AComponentWithoutAFacetGetsPoints) {
  const auto spheres = make_two_spheres(5, 4);
  std::vector<SamplePoint> sample = sparse_sample(*spheres, 1.5, 1);
  std::erase_if(sample, [](const SamplePoint& p) { return p.point.x > 0; });
  RestrictedTriangulation t = triangulated(*spheres, sample);
  const UniformSize size(2);
  KnownBoundary boundary(t);
  TopologyRepair repair(*spheres, t, boundary, size, 1);
  const std::vector<ExtraPoint> points = missing_points(repair);
  EXPECT_GE(points.size(), 4U);
  for (const ExtraPoint& p : points) {
    EXPECT_GT(p.point.x, 0);
    EXPECT_TRUE(spheres->patch_at(p.point).is_known());
  }
  EXPECT_EQ(repair.places_of({}).size(), 1U);
}

TEST(TopologyRepair, SmallBallsAreLeftAsTheyAre) {
  const auto torus = make_torus({}, 5, 0.7);
  RestrictedTriangulation t = triangulated(*torus, sparse_sample(*torus, 0.6, 9));
  const UniformSize coarse(200);  // a tenth of that is larger than all balls
  KnownBoundary coarse_boundary(t);
  TopologyRepair coarse_repair(*torus, t, coarse_boundary, coarse, 1);
  EXPECT_TRUE(missing_points(coarse_repair).empty());
}

/// One tangle: the piece of the boundary with x > 0.
Tangles one_piece(const RestrictedTriangulation& t) {
  Tangles tangles;
  tangles.pieces.emplace_back();
  for (const FacetCode facet : boundary_facets(t.triangulation())) {
    if (t.triangulation().cell(facet / 4).circumcentre.x > 0) tangles.pieces.back().push_back(facet);
  }
  tangles.all_pieces =
      std::make_shared<Pieces>(t, BoundarySurfaces(t, BoundaryFacets(t, boundary_facets(t.triangulation()))));
  return tangles;
}

TEST(TopologyRepair, PointsAtTanglesAreAroundTheChannel) {
  const test::Solids dumbbell = test::dumbbell(0.15);
  RestrictedTriangulation t = triangulated(dumbbell, without_neck(dumbbell));
  const UniformSize size(1.5);
  KnownBoundary boundary(t);
  TopologyRepair repair(dumbbell, t, boundary, size, 1);
  const Tangles tangles = one_piece(t);
  const std::vector<ExtraPoint> points = repair.points_at(tangles);
  EXPECT_GE(points.size(), 6U);
  for (const ExtraPoint& p : points) EXPECT_LT(std::abs(p.point.x), 4);
  EXPECT_EQ(repair.places_of(tangles).size(), 1U);
}

// The dumbbell without its neck has the same sample, and no channel.
TEST(TopologyRepair, LooksForAChannelOnceFromAPieceThatHasNone) {
  const test::Solids balls({{{-5, 0, 0}, 3.1}, {{5, 0.3, 0.2}, 2.9}}, {});
  const test::CountingDomain counted(balls);
  RestrictedTriangulation t = triangulated(balls, without_neck(test::dumbbell(0.15)));
  const UniformSize size(1.5);
  KnownBoundary boundary(t);
  TopologyRepair repair(counted, t, boundary, size, 1);
  const Tangles tangles = one_piece(t);
  EXPECT_TRUE(repair.points_at(tangles).empty());
  EXPECT_GT(counted.lines, 1000);
  counted.lines = 0;
  EXPECT_TRUE(repair.points_at(tangles).empty());
  EXPECT_EQ(counted.lines, 0);
}

}  // namespace
}  // namespace scantet::engine
