// A walk along a segment meets every cell that a close look at the segment's points meets.
#include <algorithm>
#include <set>

#include "scantet/domain/analytic.h"
#include "scantet/surface/watched_ways_impl.h"
#include "scantet/surface/way_walk_impl.h"
#include "unit/surface/samples.h"

namespace scantet::engine {
namespace {

/// The cells that hold at least three in a row of 20,000 points on the segment, evenly apart, from a share of it on.
std::set<CellId> cells_on(Triangulation& t, const Segment& way, double from, CellId start) {
  constexpr int kPoints = 20'000;
  Inserter inserter(t);
  std::set<CellId> cells;
  CellId at = start;
  int in_a_row = 0;
  for (int n = static_cast<int>(from * kPoints); n <= kPoints; ++n) {
    const CellId before = at;
    at = inserter.cell_at(lerp(way.source, way.target, double(n) / kPoints), at);
    in_a_row = at == before ? in_a_row + 1 : 1;
    if (in_a_row == 3) cells.insert(at);
  }
  return cells;
}

class WayWalkTest : public testing::Test {
 protected:
  void expect_all_cells(const Segment& way, double from) {
    const CellId start = any_cell(t());
    WayWalk walk(t(), start);
    std::set<CellId> met;
    walk.run(way, [&](CellId cell, const Point& place) {
      met.insert(cell);
      Inserter inserter(t());
      EXPECT_EQ(inserter.cell_at(place, cell), cell) << "the place is in the cell";
    });
    const std::set<CellId> expected = cells_on(t(), way, from, start);
    EXPECT_FALSE(expected.empty());
    EXPECT_TRUE(std::includes(met.begin(), met.end(), expected.begin(), expected.end()));
  }
  Triangulation& t() { return triangulation_.triangulation(); }

  std::unique_ptr<Domain> torus_ = make_torus({}, 5, 2);
  RestrictedTriangulation triangulation_ = triangulated(*torus_, sparse_sample(*torus_, 0.8, 1));
};

TEST_F(WayWalkTest, MeetsAllCellsOfWaysAcross) {
  for (int n = 0; n < 50; ++n) {
    const double angle = 0.37 * n;
    const Vec to{std::cos(angle), std::sin(angle), 0.3 * std::sin(7 * angle)};
    expect_all_cells({Point{0.01 * n, 0, 0.02} - 6.5 * to, Point{0, 0.01 * n, 0} + 6.5 * to}, 0);
  }
}

TEST_F(WayWalkTest, MeetsAllCellsOfWaysThatBeginHardlyOffAnEdge) {
  for (CellId c = 0; c < t().cell_slots(); c += 50) {
    if (!t().is_cell(c) || t().has_corner(c)) continue;
    const auto [a, b, unused_c, unused_d] = t().points_of(c);
    expect_all_cells({a, a + 2 * (b - a) + Vec{3e-9, 5e-9, -7e-9}}, 0.501);
  }
}

TEST_F(WayWalkTest, GoesOnFromWhereItWas) {
  const CellId start = any_cell(t());
  WayWalk walk(t(), start);
  std::vector<CellId> first;
  const Segment way{{4, 0, 0.1}, {6, 1, 0.2}};
  walk.run(way, [&](CellId cell, const Point&) { first.push_back(cell); });
  walk.go_to(first.front());
  std::vector<CellId> second;
  walk.run(way, [&](CellId cell, const Point&) { second.push_back(cell); });
  EXPECT_EQ(first, second);
}

}  // namespace
}  // namespace scantet::engine
