#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "unit/delaunay/triangulations.h"

namespace scantet::engine {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Peer = CGAL::Delaunay_triangulation_3<Kernel>;

Tets tets_of(const Peer& peer) {
  Tets tets;
  for (auto cell : peer.finite_cell_handles()) {
    Corners tet;
    for (int i = 0; i < 4; ++i) {
      const auto& p = cell->vertex(i)->point();
      tet[static_cast<std::size_t>(i)] = {p.x(), p.y(), p.z()};
    }
    tets.insert(sorted(tet));
  }
  return tets;
}

Peer peer_of(const std::vector<SamplePoint>& points) {
  Peer peer;
  for (const SamplePoint& p : points) peer.insert({p.point.x, p.point.y, p.point.z});
  return peer;
}

TEST(Triangulation, OfRandomPointsIsThatOfCgalButForItsHull) {
  const std::vector<SamplePoint> points = random_points(12'000, 10, 1);
  Triangulation t(bounds_of(points));
  insert_in_bulk(points, t, silent);
  expect_valid(t);
  EXPECT_EQ(t.vertex_count(), points.size());
  const Tets ours = tets_of(t);
  const Tets theirs = tets_of(peer_of(points));
  EXPECT_GT(ours.size(), theirs.size() * 99 / 100);  // flat tets at the hull are left to the corners
  for (const Corners& tet : ours) EXPECT_EQ(theirs.count(tet), 1U);
}

TEST(Triangulation, OfALatticeDependsOnThePointsOnly) {
  std::vector<SamplePoint> points = cubic_lattice(14);
  Triangulation once(bounds_of(points));
  insert_in_bulk(points, once, silent);
  expect_valid(once);
  std::shuffle(points.begin(), points.end(), std::mt19937(7));
  const Triangulation again = inserted_one_by_one(points);
  expect_valid(again);
  EXPECT_TRUE(tets_of(once) == tets_of(again));
  EXPECT_TRUE(tets_of(once) == tets_of(peer_of(points)));  // the perturbation is CGAL's
}

TEST(Triangulation, OfPointsInAPlaneHasOnlyTetsWithCorners) {
  std::vector<SamplePoint> points = random_points(500, 5, 4);
  for (SamplePoint& p : points) p.point.z = 2;
  Triangulation t(bounds_of(points));
  insert_in_bulk(points, t, silent);
  expect_valid(t);
  EXPECT_TRUE(tets_of(t).empty());
}

TEST(Triangulation, StarsAreTheCellsThatHaveTheVertex) {
  const std::vector<SamplePoint> points = random_points(500, 5, 8);
  Triangulation t(bounds_of(points));
  insert_in_bulk(points, t, silent);
  std::vector<std::vector<CellId>> expected(t.vertex_slots());
  for (CellId c = 0; c < t.cell_slots(); ++c) {
    for (const PointId v : t.cell(c).vertex) expected[v].push_back(c);
  }
  std::vector<CellId> star;
  for (PointId v = Triangulation::kCorners; v < t.vertex_slots(); ++v) {
    t.star_of(v, star);
    std::sort(star.begin(), star.end());
    EXPECT_EQ(star, expected[v]);
  }
}

}  // namespace
}  // namespace scantet::engine
