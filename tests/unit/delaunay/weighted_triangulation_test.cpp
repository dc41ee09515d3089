// With weights the triangulation is CGAL's regular triangulation.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>

#include "unit/delaunay/triangulations.h"

namespace scantet::engine {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using WeightedPeer = CGAL::Regular_triangulation_3<Kernel>;

/// Balls in a row along the z axis, each over half a radius of the next, and points at random off them.
std::vector<SamplePoint> points_around_balls(std::size_t count, unsigned seed) {
  constexpr double kRadius = 0.4;
  std::vector<SamplePoint> points;
  for (int i = 0; i < 14; ++i) points.push_back({{5, 5, 1 + 1.5 * kRadius * i}, 1, {}, kRadius * kRadius});
  const std::size_t balls = points.size();
  for (const SamplePoint& p : random_points(count, 10, seed)) {
    const bool is_free = std::all_of(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(balls),
                                     [&](const SamplePoint& b) { return distance(b.point, p.point) > kRadius; });
    if (is_free) points.push_back(p);
  }
  return points;
}

Tets tets_of_peer(const std::vector<SamplePoint>& points) {
  WeightedPeer peer;
  for (const SamplePoint& p : points) peer.insert({{p.point.x, p.point.y, p.point.z}, p.weight});
  Tets tets;
  for (auto cell : peer.finite_cell_handles()) {
    Corners tet;
    for (int i = 0; i < 4; ++i) {
      const auto p = cell->vertex(i)->point().point();
      tet[static_cast<std::size_t>(i)] = {p.x(), p.y(), p.z()};
    }
    tets.insert(sorted(tet));
  }
  return tets;
}

TEST(WeightedTriangulation, IsThatOfCgalButForItsHull) {
  for (const std::size_t count : {300, 20'000}) {
    const std::vector<SamplePoint> points = points_around_balls(count, 3);
    Triangulation t(bounds_of(points));
    insert_in_bulk(points, t, silent);
    EXPECT_EQ(t.vertex_count(), points.size());
    const Tets ours = tets_of(t);
    const Tets theirs = tets_of_peer(points);
    EXPECT_GT(ours.size(), theirs.size() * 9 / 10);  // flat tets at the hull are left to the corners
    for (const Corners& tet : ours) EXPECT_EQ(theirs.count(tet), 1U);
  }
}

TEST(WeightedTriangulation, HasTheSegmentsBetweenNeighboursAsEdges) {
  const std::vector<SamplePoint> points = points_around_balls(5000, 4);
  Triangulation t(bounds_of(points));
  insert_in_bulk(points, t, silent);
  std::vector<CellId> star;
  for (PointId i = Triangulation::kCorners; i + 1 < Triangulation::kCorners + 14; ++i) {
    EXPECT_DOUBLE_EQ(t.weight(i), 0.16);
    t.star_of(i, star);
    EXPECT_TRUE(std::any_of(star.begin(), star.end(), [&](CellId c) {
      const auto& v = t.cell(c).vertex;
      return std::find(v.begin(), v.end(), i + 1) != v.end();
    }));
  }
}

TEST(WeightedTriangulation, TakesNoPointInABall) {
  std::vector<SamplePoint> points = points_around_balls(500, 5);
  Triangulation t(bounds_of(points));
  insert_in_bulk(points, t, silent);
  Inserter inserter(t);
  ConflictZone zone;
  EXPECT_EQ(inserter.find_zone({5.1, 5.1, 3.1}, kNone, zone), Inserter::Found::vertex);
  EXPECT_EQ(inserter.find_zone({5.6, 5.6, 3.1}, kNone, zone), Inserter::Found::zone);
  EXPECT_TRUE(std::all_of(zone.cells.begin(), zone.cells.end(), [&](CellId c) { return t.is_cell(c); }));
}

TEST(WeightedTriangulation, OfALatticeDependsOnThePointsOnly) {
  std::vector<SamplePoint> points = cubic_lattice(8);
  const auto is_ball = [](const SamplePoint& p) { return p.point.x == 4 && p.point.y == 4; };
  for (SamplePoint& p : points) p.weight = is_ball(p) ? 0.3025 : 0;  // radius 0.55: ties wherever there are no balls
  std::stable_partition(points.begin(), points.end(), is_ball);
  Triangulation once(bounds_of(points));
  insert_in_bulk(points, once, silent);
  std::shuffle(points.begin() + 8, points.end(), std::mt19937(7));
  Triangulation again(bounds_of(points));
  insert_in_bulk(points, again, silent);
  EXPECT_TRUE(tets_of(once) == tets_of(again));
  EXPECT_TRUE(tets_of(once) == tets_of_peer(points));  // the perturbation is CGAL's
}

}  // namespace
}  // namespace scantet::engine
