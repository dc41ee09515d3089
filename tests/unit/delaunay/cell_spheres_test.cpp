#include <cmath>
#include <map>

#include "scantet/delaunay/circumcentre.h"
#include "unit/delaunay/triangulations.h"

namespace scantet::engine {
namespace {

std::vector<CellId> cells_of(const Triangulation& t) {
  std::vector<CellId> cells;
  for (CellId c = 0; c < t.cell_slots(); ++c) {
    if (t.is_cell(c) && !t.has_corner(c)) cells.push_back(c);
  }
  return cells;
}

/// Points whose tets are of all shapes: most of those of the lattice are flat but for a little noise.
std::vector<SamplePoint> of_all_shapes() {
  std::vector<SamplePoint> points = cubic_lattice(7);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> digit(0, 16);
  for (SamplePoint& p : points) p.point.z += std::pow(10.0, -digit(random));
  return points;
}

TEST(CellSpheres, CertainSidesAgreeWithExactArithmetic) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto point = [&] { return Point{coordinate(random), coordinate(random), coordinate(random)}; };
  for (int round = 0; round < 20'000; ++round) {
    Corners tet{point(), point(), point(), point()};
    const double flatness = std::pow(10.0, -(round % 16));  // down to tets that doubles cannot tell from flat ones
    for (Point& p : tet) {
      const double radius = std::hypot(p.x, p.y);
      if (round % 32 < 16) p = {p.x / radius, p.y / radius, p.z};  // slivers, whose spheres are no larger than they
      p.z *= flatness;
    }
    const int sign = exact_orientation(tet[0], tet[1], tet[2], tet[3]);
    if (sign == 0) continue;
    if (sign < 0) std::swap(tet[2], tet[3]);
    std::vector<SamplePoint> points;
    for (const Point& p : tet) points.push_back({p, 3});
    Triangulation t(bounds_of(points));
    insert_in_bulk(points, t, silent);
    for (CellId c = 0; c < t.cell_slots(); ++c) {
      if (!t.is_cell(c) || t.has_corner(c)) continue;
      for (const Point& p : tet) {  // up to as near to the sphere as doubles go
        for (const double off : {1e-12, 1e-7, 1e-4, 1e-2, 1.0}) {
          const Point q = p + off * point();
          EXPECT_EQ(t.in_conflict(c, q), exact_in_sphere(t.points_of(c), q));
        }
      }
    }
  }
}

TEST(CellSpheres, OfGoodTetsLeaveLittleInDoubt) {
  const std::vector<SamplePoint> points = random_points(2000, 10, 1);
  Triangulation t(bounds_of(points));
  insert_in_bulk(points, t, silent);
  const std::vector<CellId> cells = cells_of(t);
  std::size_t narrow = 0;
  for (const CellId c : cells) {
    const Cell& cell = t.cell(c);
    const double squared = squared_distance(cell.circumcentre, t.point(cell.vertex[0]));
    EXPECT_LT(cell.surely_inside, squared);
    EXPECT_GT(cell.surely_outside, squared);
    narrow += cell.surely_outside - cell.surely_inside < 2e-6 * squared ? 1 : 0;
  }
  EXPECT_GT(narrow, cells.size() * 9 / 10);
}

TEST(CellSpheres, LastingOnesDependOnTheFourPointsAlone) {
  std::vector<SamplePoint> points = of_all_shapes();
  Triangulation t(bounds_of(points));
  insert_in_bulk(points, t, silent);
  std::map<Corners, Point, LexicographicallyLess> centres;
  for (const CellId c : cells_of(t)) centres[sorted(t.points_of(c))] = t.cell(c).circumcentre;
  std::shuffle(points.begin(), points.end(), std::mt19937(5));
  Triangulation again = inserted_one_by_one(points);  // its cells have their vertices in other orders
  const std::vector<CellId> cells = cells_of(again);
  EXPECT_EQ(cells.size(), centres.size());
  again.find_lasting_spheres(cells);
  for (const CellId c : cells) {
    const Point among_others = again.cell(c).circumcentre;
    again.find_lasting_spheres(std::array{c});
    EXPECT_EQ(again.cell(c).circumcentre, among_others);
    EXPECT_EQ(centres.at(sorted(again.points_of(c))), among_others);
  }
}

TEST(CellSpheres, LastingCentresAreRightHoweverFlatTheTet) {
  const std::vector<SamplePoint> points = of_all_shapes();
  Triangulation t(bounds_of(points));
  insert_in_bulk(points, t, silent);
  for (const CellId c : cells_of(t)) {
    const Point& centre = t.cell(c).circumcentre;
    ASSERT_TRUE(std::isfinite(centre.x) && std::isfinite(centre.y) && std::isfinite(centre.z));
    const double radius = distance(centre, t.point(t.cell(c).vertex[0]));
    for (const Point& p : t.points_of(c)) EXPECT_NEAR(distance(centre, p), radius, 1e-6 * radius);
    EXPECT_LT(distance(centre, circumcentre(t.points_of(c))), 1e-3 * radius);
  }
}

}  // namespace
}  // namespace scantet::engine
