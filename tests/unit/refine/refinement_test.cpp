#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "scantet/base/parallel.h"
#include "scantet/domain/analytic.h"
#include "scantet/refine/refinement_impl.h"

namespace scantet::engine {
namespace {

TEST(Refinement, PassesOverExtraPointsThatAreNotClear) {
  const auto sphere = make_sphere({}, 10);
  std::vector<SamplePoint> sample;
  sphere->surface_candidates(4, [&](const Point& p) { sample.push_back({p, 2}); });
  RestrictedTriangulation t(*sphere);
  Progress progress;
  ASSERT_TRUE(t.build(sample, progress));
  const UniformSize size(8);
  Refinement refinement(t, size, {}, progress);
  const std::uint64_t before = t.vertex_count();

  const Point vertex = sample.front().point;
  const auto beside = [](const Point& p, double mm) {  // on the sphere, about so far from p
    const Vec q = p + mm * Vec{p.y, p.z, p.x} - (mm * dot(p, Vec{p.y, p.z, p.x}) / dot(p, p)) * p;
    return (10 / length(q)) * q;
  };
  const Point other = beside(vertex, 0.05);
  const double gap = distance(vertex, other);
  EXPECT_EQ(refinement.add({{other, 1.01 * gap}}), 0U);
  EXPECT_EQ(refinement.add({{other, 0.99 * gap}}), 1U);
  EXPECT_EQ(refinement.add({{other, 0}}), 0U);  // a vertex by now
  const Point near = beside(other, 0.01);
  const std::vector<ExtraPoint> two{{near, 0}, {beside(near, 0.001), 0.5 * distance(near, other)}};
  EXPECT_EQ(refinement.add(two), 1U);  // the second is too near to the first
  EXPECT_EQ(t.vertex_count(), before + 2);
}

/// A sphere with a dense sample, and points of it that are asked for beside, each near one of its balls' facets.
struct ManyExtraPoints {
  ManyExtraPoints() {
    std::vector<SamplePoint> sample;
    sphere->surface_candidates(0.2, [&](const Point& p) { sample.push_back({p, 2}); });
    triangulation.build(sample, progress);
    const SurfaceBalls& balls = triangulation.balls();
    for (std::uint32_t b = 0; b < balls.slots() && points.size() < kPoints; b += 3) {
      if (balls[b].generation % 2 == 1) points.push_back({balls[b].center, 0, balls[b].facet / 4});
    }
    std::sort(points.begin(), points.end(), clearer);
  }
  /// The vertices, cell by cell, after the points were added.
  std::vector<PointId> cells_after_adding(std::uint64_t& added) {
    Refinement refinement(triangulation, size, {}, progress);
    added = refinement.add(points);
    std::vector<PointId> cells;
    const Triangulation& t = triangulation.triangulation();
    for (CellId c = 0; c < t.cell_slots(); ++c) {
      if (t.is_cell(c)) cells.insert(cells.end(), t.cell(c).vertex.begin(), t.cell(c).vertex.end());
    }
    return cells;
  }

  static constexpr std::size_t kPoints = 4000;
  std::unique_ptr<Domain> sphere = make_sphere({}, 10);
  RestrictedTriangulation triangulation{*sphere};
  UniformSize size{8};
  Progress progress;
  std::vector<ExtraPoint> points;
};

TEST(Refinement, AddsAllExtraPointsWhetherInAPartOrBetween) {
  ManyExtraPoints many;
  ASSERT_EQ(many.points.size(), ManyExtraPoints::kPoints);
  const std::uint64_t before = many.triangulation.vertex_count();
  ASSERT_GT(before, 24'000U) << "too few for parts";
  std::uint64_t added = 0;
  many.cells_after_adding(added);
  EXPECT_EQ(added, ManyExtraPoints::kPoints);
  EXPECT_EQ(many.triangulation.vertex_count(), before + ManyExtraPoints::kPoints);
  std::set<std::array<double, 3>> vertices;
  const Triangulation& t = many.triangulation.triangulation();
  for (PointId v = Triangulation::kCorners; v < t.vertex_slots(); ++v) {
    if (t.is_vertex(v)) vertices.insert({t.point(v).x, t.point(v).y, t.point(v).z});
  }
  for (const ExtraPoint& p : many.points) EXPECT_TRUE(vertices.contains({p.point.x, p.point.y, p.point.z}));
}

TEST(Refinement, ExtraPointsMakeTheSameCellsWithAnyNumberOfThreads) {
  std::array<std::vector<PointId>, 2> cells;
  for (std::size_t n = 0; n < 2; ++n) {
    with_threads(n == 0 ? 1 : 4, [&] {
      std::uint64_t added = 0;
      cells[n] = ManyExtraPoints().cells_after_adding(added);
    });
  }
  EXPECT_EQ(cells[0], cells[1]);
}

}  // namespace
}  // namespace scantet::engine
