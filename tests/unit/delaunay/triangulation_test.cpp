#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "scantet/base/parallel.h"
#include "scantet/delaunay/bulk_insertion_impl.h"
#include "scantet/delaunay/inserter_impl.h"
#include "scantet/delaunay/lattice_core_impl.h"
#include "scantet/delaunay/predicates_impl.h"
#include "scantet/delaunay/triangulation_impl.h"

namespace scantet::engine {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Peer = CGAL::Delaunay_triangulation_3<Kernel>;
using Corners = std::array<Point, 4>;

struct Less {
  bool operator()(const Corners& a, const Corners& b) const {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), lexicographically_less);
  }
};
using Tets = std::set<Corners, Less>;

Progress silent;

std::vector<SamplePoint> random_points(std::size_t count, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(0, size);
  std::vector<SamplePoint> points(count);
  for (SamplePoint& p : points) p.point = {coordinate(random), coordinate(random), coordinate(random)};
  return points;
}

/// A cubic lattice: every eight points that are neighbours lie on one sphere.
std::vector<SamplePoint> lattice(int side) {
  std::vector<SamplePoint> points;
  for (int i = 0; i < side * side * side; ++i) {
    points.push_back({{double(i % side), double(i / side % side), double(i / side / side)}, 3});
  }
  return points;
}

Box bounds_of(const std::vector<SamplePoint>& points) {
  Box box;
  for (const SamplePoint& p : points) box.extend(p.point);
  box.extend(box.min - Vec{1, 1, 1});
  box.extend(box.max + Vec{1, 1, 1});
  return box;
}

Corners sorted(Corners tet) {
  std::sort(tet.begin(), tet.end(), lexicographically_less);
  return tet;
}

/// The tets without a far corner.
Tets tets_of(const Triangulation& t) {
  Tets tets;
  for (CellId c = 0; c < t.cell_slots(); ++c) {
    if (t.is_cell(c) && !t.has_corner(c)) tets.insert(sorted(t.points_of(c)));
  }
  return tets;
}

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

/// Neighbours know each other, tets are positive, no vertex across a facet is inside a tet's sphere.
void expect_valid(const Triangulation& t) {
  std::size_t faults = 0;
  for (CellId c = 0; c < t.cell_slots(); ++c) {
    if (!t.is_cell(c)) continue;
    const Corners p = t.points_of(c);
    faults += exact_orientation(p[0], p[1], p[2], p[3]) > 0 ? 0 : 1;
    for (std::uint32_t i = 0; i < 4; ++i) {
      const FacetCode across = t.cell(c).neighbor[i];
      if (across == kNone) continue;
      faults += t.cell(across / 4).neighbor[across % 4] == 4 * c + i ? 0 : 1;
      const PointId beyond = t.cell(across / 4).vertex[across % 4];
      if (beyond >= Triangulation::kCorners) faults += t.in_conflict(c, t.point(beyond)) ? 1 : 0;
    }
  }
  EXPECT_EQ(faults, 0U);
  for (PointId v = Triangulation::kCorners; v < t.vertex_slots(); ++v) {
    if (!t.is_vertex(v)) continue;
    const auto& around = t.cell(t.vertex(v).cell).vertex;
    EXPECT_NE(std::find(around.begin(), around.end(), v), around.end());
  }
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
  std::vector<SamplePoint> points = lattice(14);
  Triangulation once(bounds_of(points));
  insert_in_bulk(points, once, silent);
  expect_valid(once);
  std::shuffle(points.begin(), points.end(), std::mt19937(7));
  Triangulation again(bounds_of(points));
  Inserter inserter(again);
  ConflictZone zone;
  for (const SamplePoint& p : points) {
    ASSERT_EQ(inserter.find_zone(p.point, kNone, zone), Inserter::Found::zone);
    const PointId v = again.add_vertices(1);
    again.vertex(v) = {.point = p.point};
    inserter.insert(v, zone);
    again.find_spheres(inserter.new_cells());
  }
  inserter.retire();
  expect_valid(again);
  EXPECT_TRUE(tets_of(once) == tets_of(again));
  EXPECT_TRUE(tets_of(once) == tets_of(peer_of(points)));  // the perturbation is CGAL's
}

TEST(Triangulation, DropsDuplicates) {
  std::vector<SamplePoint> points = random_points(3000, 5, 3);
  points.insert(points.end(), points.begin(), points.begin() + 1500);
  Triangulation t(bounds_of(points));
  insert_in_bulk(points, t, silent);
  EXPECT_EQ(t.vertex_count(), 3000U);
  Inserter inserter(t);
  ConflictZone zone;
  EXPECT_EQ(inserter.find_zone(points[5].point, kNone, zone), Inserter::Found::vertex);
}

TEST(Triangulation, OfPointsInAPlaneHasOnlyTetsWithCorners) {
  std::vector<SamplePoint> points = random_points(500, 5, 4);
  for (SamplePoint& p : points) p.point.z = 2;
  Triangulation t(bounds_of(points));
  insert_in_bulk(points, t, silent);
  expect_valid(t);
  EXPECT_TRUE(tets_of(t).empty());
}

/// Everything but the points.
std::vector<std::uint32_t> numbers_of(const Triangulation& t) {
  std::vector<std::uint32_t> all;
  for (CellId c = 0; c < t.cell_slots(); ++c) {
    if (!t.is_cell(c)) continue;
    all.push_back(c);
    all.insert(all.end(), t.cell(c).vertex.begin(), t.cell(c).vertex.end());
    all.insert(all.end(), t.cell(c).neighbor.begin(), t.cell(c).neighbor.end());
  }
  return all;
}

TEST(Triangulation, NumbersAreTheSameForAnyNumberOfThreads) {
  std::vector<SamplePoint> points = random_points(60'000, 40, 5);
  const auto codes = [&](std::size_t threads) {
    std::vector<std::uint32_t> all;
    with_threads(threads, [&] {
      Triangulation t(bounds_of(points));
      insert_in_bulk(points, t, silent);
      all = numbers_of(t);
    });
    return all;
  };
  const auto one = codes(1);
  for (const std::size_t threads : {2, 3, 8}) EXPECT_TRUE(codes(threads) == one) << threads;
}

/// A body-centred cubic lattice in a box of so many cubes; `share` of its points are missing.
std::vector<SamplePoint> body_centred(const SeedLattice& lattice, std::array<int, 3> cubes, double share,
                                      unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> missing(0, 1);
  std::uniform_real_distribution<double> off(-1e-4, 1e-4);
  std::vector<SamplePoint> points;
  for (int i = 0; i < 2 * cubes[0] * cubes[1] * cubes[2]; ++i) {
    const int cube = i / 2;
    const double half = i % 2 == 0 ? 0.0 : 0.5;
    const Vec place{cube % cubes[0] + half + off(random), cube / cubes[0] % cubes[1] + half + off(random),
                    cube / cubes[0] / cubes[1] + half + off(random)};
    if (missing(random) >= share) points.push_back({lattice.corner + lattice.side_mm * place, 3});
  }
  return points;
}

class TriangulationWithLattice : public testing::Test {
 protected:
  /// Expects the same tets with and without the lattice, and so many points at least that are not inserted.
  void expect_same_tets(const std::vector<SamplePoint>& points, std::size_t least_core) const {
    Triangulation without(bounds_of(points));
    insert_in_bulk(points, without, silent);
    Triangulation with(bounds_of(points));
    insert_in_bulk(points, with, silent, lattice_);
    expect_valid(with);
    EXPECT_EQ(with.vertex_count(), without.vertex_count());
    EXPECT_TRUE(tets_of(with) == tets_of(without));
    Triangulation empty(bounds_of(points));
    const PointId first = empty.add_vertices(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) empty.vertex(first + PointId(i)) = {.point = points[i].point};
    const LatticeCore core(lattice_, empty);
    std::size_t in_core = 0;
    for (PointId v = 0; v < empty.vertex_slots(); ++v) in_core += core.has(v) ? 1 : 0;
    EXPECT_GE(in_core, least_core);
    EXPECT_EQ(core.empty(), in_core == 0);
  }

  const SeedLattice lattice_{{-3, 7, 0.3}, 0.37};
};

TEST_F(TriangulationWithLattice, ABoxOfItIsTheSame) {
  expect_same_tets(body_centred(lattice_, {20, 12, 9}, 0, 1), 2000);
}

TEST_F(TriangulationWithLattice, AmongOtherPointsItIsTheSame) {
  std::vector<SamplePoint> points = body_centred(lattice_, {24, 20, 18}, 0, 2);
  const Box box = bounds_of(points);
  std::erase_if(points, [&](const SamplePoint& p) { return distance(p.point, box.center()) > 3; });
  std::mt19937 random(3);
  std::normal_distribution<double> coordinate;
  for (int i = 0; i < 3000; ++i) {
    Vec direction{coordinate(random), coordinate(random), coordinate(random)};
    const double radius = i % 4 == 0 ? 0.5 : 3.2;  // a cavity, and a surface around
    points.push_back({box.center() + (radius / length(direction)) * direction, 2});
  }
  expect_same_tets(points, 1000);
}

TEST_F(TriangulationWithLattice, WithHolesInItItIsTheSame) {
  for (const double share : {0.002, 0.02, 0.2}) {
    expect_same_tets(body_centred(lattice_, {20, 20, 20}, share, 4), share < 0.1 ? 1000 : 0);
  }
}

TEST_F(TriangulationWithLattice, PartsOfItThatTouchAreTheSame) {
  std::vector<SamplePoint> points = body_centred(lattice_, {30, 16, 16}, 0, 5);
  const Point middle = bounds_of(points).center();
  std::erase_if(points, [&](const SamplePoint& p) {  // two blocks that share an edge, and a sheet
    return (p.point.x < middle.x) == (p.point.y < middle.y) && std::abs(p.point.z - middle.z) > 0.5;
  });
  expect_same_tets(points, 1000);
}

TEST_F(TriangulationWithLattice, PointsTwiceInAPlaceAreDropped) {
  std::vector<SamplePoint> points = body_centred(lattice_, {14, 14, 14}, 0, 6);
  for (std::size_t i = 0; i < 900; i += 300) points.push_back(points[2000 + i]);
  expect_same_tets(points, 1000);
}

TEST_F(TriangulationWithLattice, PointsExactlyInPlaceAreTheSame) {
  std::vector<SamplePoint> points;
  for (int i = 0; i < 2 * 10 * 10 * 10; ++i) {
    const double half = i % 2 == 0 ? 0.0 : 0.5;
    points.push_back({{i / 2 % 10 + half, i / 20 % 10 + half, i / 200 + half}, 3});
  }
  Triangulation without(bounds_of(points));
  insert_in_bulk(points, without, silent);
  Triangulation with(bounds_of(points));
  insert_in_bulk(points, with, silent, {{0, 0, 0}, 1});
  expect_valid(with);
  EXPECT_TRUE(tets_of(with) == tets_of(without));
}

TEST_F(TriangulationWithLattice, NumbersAreTheSameForAnyNumberOfThreads) {
  const std::vector<SamplePoint> points = body_centred(lattice_, {40, 30, 25}, 0.01, 7);
  const auto codes = [&](std::size_t threads) {
    std::vector<std::uint32_t> all;
    with_threads(threads, [&] {
      Triangulation t(bounds_of(points));
      insert_in_bulk(points, t, silent, lattice_);
      all = numbers_of(t);
    });
    return all;
  };
  const auto one = codes(1);
  for (const std::size_t threads : {2, 3, 8}) EXPECT_TRUE(codes(threads) == one) << threads;
}

TEST(Triangulation, CertainSidesOfSpheresAgreeWithExactArithmetic) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto point = [&] { return Point{coordinate(random), coordinate(random), coordinate(random)}; };
  for (int round = 0; round < 20'000; ++round) {
    Corners tet{point(), point(), point(), point()};
    const double flatness = std::pow(10.0, -(round % 16));  // down to tets that doubles cannot tell from flat ones
    for (Point& p : tet) p.z *= flatness;
    const int sign = exact_orientation(tet[0], tet[1], tet[2], tet[3]);
    if (sign == 0) continue;
    if (sign < 0) std::swap(tet[2], tet[3]);
    std::vector<SamplePoint> points;
    for (const Point& p : tet) points.push_back({p, 3});
    Triangulation t(bounds_of(points));
    insert_in_bulk(points, t, silent);
    for (CellId c = 0; c < t.cell_slots(); ++c) {
      if (!t.is_cell(c) || t.has_corner(c)) continue;
      for (const Point& p : tet) {  // as near to the sphere as doubles go
        const Point q = p + 1e-12 * point();
        EXPECT_EQ(t.in_conflict(c, q), exact_in_sphere(t.points_of(c), q));
      }
      const Point q = point();
      EXPECT_EQ(t.in_conflict(c, q), exact_in_sphere(t.points_of(c), q));
    }
  }
}

TEST(Predicates, PerturbationIsConsistentOnACube) {
  // Of two neighbouring tets with all points on one sphere, each contains the other's far vertex or neither does.
  const Point o{0, 0, 0};
  const Point x{1, 0, 0};
  const Point y{0, 1, 0};
  const Point z{0, 0, 1};
  const Point xyz{1, 1, 1};
  ASSERT_GT(exact_orientation(o, x, y, z), 0);
  ASSERT_GT(exact_orientation(x, xyz, y, z), 0);
  EXPECT_EQ(exact_in_sphere({o, x, y, z}, xyz), exact_in_sphere({x, xyz, y, z}, o));
}

}  // namespace
}  // namespace scantet::engine
