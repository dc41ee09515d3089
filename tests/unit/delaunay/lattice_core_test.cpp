// Triangulations with a lattice that need not be inserted, against those with all points inserted.
#include "scantet/base/parallel.h"
#include "scantet/delaunay/lattice_core_impl.h"
#include "unit/delaunay/triangulations.h"

namespace scantet::engine {
namespace {

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

class LatticeCoreTest : public testing::Test {
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

TEST_F(LatticeCoreTest, ABoxOfItIsTheSame) {
  expect_same_tets(body_centred(lattice_, {20, 12, 9}, 0, 1), 2000);
}

TEST_F(LatticeCoreTest, AmongOtherPointsItIsTheSame) {
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

TEST_F(LatticeCoreTest, WithHolesInItItIsTheSame) {
  for (const double share : {0.002, 0.02, 0.2}) {
    expect_same_tets(body_centred(lattice_, {20, 20, 20}, share, 4), share < 0.1 ? 1000 : 0);
  }
}

TEST_F(LatticeCoreTest, PartsOfItThatTouchAreTheSame) {
  std::vector<SamplePoint> points = body_centred(lattice_, {30, 16, 16}, 0, 5);
  const Point middle = bounds_of(points).center();
  std::erase_if(points, [&](const SamplePoint& p) {  // two blocks that share an edge, and a sheet
    return (p.point.x < middle.x) == (p.point.y < middle.y) && std::abs(p.point.z - middle.z) > 0.5;
  });
  expect_same_tets(points, 1000);
}

TEST_F(LatticeCoreTest, PointsTwiceInAPlaceAreDropped) {
  std::vector<SamplePoint> points = body_centred(lattice_, {14, 14, 14}, 0, 6);
  for (std::size_t i = 0; i < 900; i += 300) points.push_back(points[2000 + i]);
  expect_same_tets(points, 1000);
}

TEST_F(LatticeCoreTest, PointsExactlyInPlaceAreTheSame) {
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

TEST_F(LatticeCoreTest, NumbersAreTheSameForAnyNumberOfThreads) {
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

/// Distances from p to the other points, in sides of the lattice, ascending.
std::vector<double> distances(const std::vector<SamplePoint>& points, const Point& p, double side_mm) {
  std::vector<double> all;
  for (const SamplePoint& q : points) {
    if (q.point != p) all.push_back(distance(q.point, p) / side_mm);
  }
  std::sort(all.begin(), all.end());
  return all;
}

TEST_F(LatticeCoreTest, HasThePointsWhoseFourteenNeighboursAreThereAndAlone) {
  std::vector<SamplePoint> points = body_centred(lattice_, {9, 9, 9}, 0.01, 8);
  const Box box = bounds_of(points);
  points.push_back({box.center() + Vec{0.1, 0.07, 0.03}, 3});  // off every place
  Triangulation t(box);
  const PointId first = t.add_vertices(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) t.vertex(first + PointId(i)) = {.point = points[i].point};
  const LatticeCore core(lattice_, t);
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::vector<double> far = distances(points, points[i].point, lattice_.side_mm);
    // Eight neighbours at √3/2, six at 1, the next at √2; another point within √5/2 would come between.
    const bool all_there = std::abs(far[7] - std::sqrt(0.75)) < 0.01 && std::abs(far[13] - 1) < 0.01;
    const bool is_in_core = all_there && far[0] > 0.8 && far[8] > 0.98 && far[14] > 1.13;
    EXPECT_EQ(core.has(first + PointId(i)), is_in_core) << "point " << i;
    count += is_in_core ? 1 : 0;
  }
  EXPECT_GT(count, 100U);
}

}  // namespace
}  // namespace scantet::engine
