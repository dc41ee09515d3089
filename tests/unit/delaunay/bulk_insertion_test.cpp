#include "cancelled_after.h"
#include "scantet/base/parallel.h"
#include "scantet/delaunay/bulk_insertion_impl.h"
#include "scantet/delaunay/inserter_impl.h"
#include "unit/delaunay/triangulations.h"

namespace scantet::engine {
namespace {

TEST(BulkInsertion, MakesWhatInsertingOneByOneMakes) {
  std::vector<SamplePoint> layers = random_points(15'000, 20, 2);
  for (SamplePoint& p : layers) p.point.z = std::floor(p.point.z);  // many in a plane
  std::shuffle(layers.begin(), layers.end(), std::mt19937(1));
  for (const auto& points : {layers, cubic_lattice(25), random_points(5, 1, 3)}) {
    Triangulation t(bounds_of(points));
    insert_in_bulk(points, t, silent);
    expect_valid(t);
    EXPECT_EQ(t.vertex_count(), points.size());
    EXPECT_TRUE(tets_of(t) == tets_of(inserted_one_by_one(points)));
  }
}

TEST(BulkInsertion, DropsDuplicates) {
  std::vector<SamplePoint> points = random_points(3000, 5, 3);
  points.insert(points.end(), points.begin(), points.begin() + 1500);
  Triangulation t(bounds_of(points));
  insert_in_bulk(points, t, silent);
  EXPECT_EQ(t.vertex_count(), 3000U);
  Inserter inserter(t);
  ConflictZone zone;
  EXPECT_EQ(inserter.find_zone(points[5].point, kNone, zone), Inserter::Found::vertex);
}

TEST(BulkInsertion, KeepsWhatThePointsLieOn) {
  std::vector<SamplePoint> points = random_points(9000, 10, 4);
  for (SamplePoint& p : points) {
    p.dimension = static_cast<std::uint8_t>(p.point.x);
    p.patch = {{0, 1 + static_cast<Region>(p.point.y)}, {}};
  }
  Triangulation t(bounds_of(points));
  insert_in_bulk(points, t, silent);
  for (PointId v = Triangulation::kCorners; v < t.vertex_slots(); ++v) {
    ASSERT_TRUE(t.is_vertex(v));
    EXPECT_EQ(t.vertex_info(v).dimension, static_cast<std::uint8_t>(t.point(v).x));
    EXPECT_EQ(t.vertex_info(v).patch.regions[1], 1 + static_cast<Region>(t.point(v).y));
  }
}

TEST(BulkInsertion, NumbersAreTheSameForAnyNumberOfThreads) {
  const std::vector<SamplePoint> points = random_points(60'000, 40, 5);
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

TEST(BulkInsertion, StopsEarlyWhenItIsCancelled) {
  const std::vector<SamplePoint> points = random_points(40'000, 10, 6);
  std::uint64_t last = 0;
  for (const int polls : {0, 2, 1000}) {
    test::CancelledAfter progress(polls);
    Triangulation t(bounds_of(points));
    insert_in_bulk(points, t, progress);
    expect_valid(t);
    EXPECT_EQ(progress.was_cancelled(), t.vertex_count() < points.size());
    EXPECT_GT(t.vertex_count(), last);
    last = t.vertex_count();
  }
  EXPECT_EQ(last, points.size());
}

}  // namespace
}  // namespace scantet::engine
