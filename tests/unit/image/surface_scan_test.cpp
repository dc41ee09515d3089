#include "scantet/image/surface_scan.h"

#include <gtest/gtest.h>

#include <set>

#include "scantet/base/error.h"
#include "scantet/base/parallel.h"
#include "scantet/field/padded_grid.h"
#include "scantet/image/level_set.h"
#include "unit/image/test_scan.h"

namespace scantet {
namespace {

using test::kSize;

std::vector<Point> candidates(const Domain& domain, double spacing_mm) {
  std::vector<Point> points;
  domain.surface_candidates(spacing_mm, [&points](const Point& p) { points.push_back(p); });
  return points;
}

template <class Voxel>
std::size_t sign_changing_edges(const Scan& scan, const LevelSetSettings& settings) {
  const PaddedGrid<Voxel> grid = padded_grid(scan, std::get<const Voxel*>(scan.voxels), settings);
  std::size_t count = 0;
  for (int k = -1; k <= scan.size[2]; ++k) {
    for (int j = -1; j <= scan.size[1]; ++j) {
      for (int i = -1; i <= scan.size[0]; ++i) {
        const bool inside = grid.height(i, j, k) > 0;
        count += inside != (grid.height(i + 1, j, k) > 0);
        count += inside != (grid.height(i, j + 1, k) > 0);
        count += inside != (grid.height(i, j, k + 1) > 0);
      }
    }
  }
  return count;
}

TEST(SurfaceCandidates, CoarseSpacingGivesEverySignChangingEdge) {
  for (const auto& [name, frame] : test::frames()) {
    SCOPED_TRACE(name);
    const LevelSetSettings at_50{50, InsideSide::above, {}};
    const LevelSetSettings at_1{1, InsideSide::below, 3.0};
    const Scan ball = test::noisy_ball<float>(kSize, frame);
    const Scan steps = test::plateaus<std::uint8_t>(kSize, frame);
    const std::unique_ptr<Domain> ball_domain = make_level_set(ball, at_50);
    EXPECT_EQ(candidates(*ball_domain, 10).size(), sign_changing_edges<float>(ball, at_50));
    EXPECT_EQ(candidates(*make_level_set(steps, at_1), 10).size(), sign_changing_edges<std::uint8_t>(steps, at_1));
    EXPECT_EQ(candidates(*ball_domain, 10), candidates(*ball_domain, 1000));
  }
}

TEST(SurfaceCandidates, LieOnTheLevelAndComeInTheSameOrder) {
  for (const auto& [name, frame] : test::frames()) {
    SCOPED_TRACE(name);
    const std::unique_ptr<Domain> domain =
        make_level_set(test::noisy_ball<float>(kSize, frame), {50, InsideSide::above, {}});
    for (const double spacing : {10.0, 0.35}) {
      const std::vector<Point> points = candidates(*domain, spacing);
      ASSERT_FALSE(points.empty());
      for (const Point& p : points) ASSERT_LE(domain->residual_at(p).value(), 1e-9);
      EXPECT_EQ(points, candidates(*domain, spacing));
    }
  }
}

TEST(SurfaceCandidates, TheSameInTheSameOrderForAnyNumberOfThreads) {
  const std::unique_ptr<Domain> domain =
      make_level_set(test::noisy_ball<float>({60, 70, 80}, Frame()), {50, InsideSide::above, {}});
  const std::vector<Point> alone = [&] {
    std::vector<Point> points;
    with_threads(1, [&] { points = candidates(*domain, 0.6); });
    return points;
  }();
  ASSERT_GT(alone.size(), 1000U);
  for (const std::size_t threads : {2, 3, 8}) {
    with_threads(threads, [&] { EXPECT_EQ(candidates(*domain, 0.6), alone); });
  }
}

TEST(SurfaceCandidates, FinerSpacingIsDenserWithoutRepetition) {
  for (const auto& [name, frame] : test::frames()) {
    SCOPED_TRACE(name);
    const std::unique_ptr<Domain> domain =
        make_level_set(test::noisy_ball<double>(kSize, frame), {50.0001, InsideSide::above, {}});
    std::size_t before = 0;
    for (const double spacing : {5.0, 0.4, 0.2}) {
      const std::vector<Point> points = candidates(*domain, spacing);
      EXPECT_GT(points.size(), 2 * before);
      before = points.size();
      std::set<std::array<long, 3>> seen;  // to 1e-7 voxel
      for (const Point& p : points) {
        const Vec index = frame.to_index(p);
        seen.insert({std::lround(1e7 * index.x), std::lround(1e7 * index.y), std::lround(1e7 * index.z)});
      }
      EXPECT_EQ(seen.size(), points.size());
    }
  }
}

/// On a plane across the axes, lines of every direction cut it, so each point of it has a candidate close by.
TEST(SurfaceCandidates, CoverASmoothSurfaceAtTheSpacing) {
  const Scan scan = test::scan_of_function<double>({12, 12, 12}, [](int i, int j, int k) { return i + j + k; });
  const std::unique_ptr<Domain> domain = make_level_set(scan, {16.3, InsideSide::above, {}});
  const double spacing = 0.3;
  const std::vector<Point> points = candidates(*domain, spacing);
  std::mt19937 random(21);
  Crossings crossings;
  for (int n = 0; n < 300; ++n) {
    const Point middle{5.4 + 0.01 * (n % 10), 5.4, 5.4};
    domain->crossings({middle - 4 * test::random_direction(random), middle + 4 * test::random_direction(random)},
                      crossings);
    for (const Crossing& crossing : crossings) {
      if (!Box{{0, 0, 0}, {11, 11, 11}}.contains(crossing.point)) continue;
      double closest = 1e300;
      for (const Point& p : points) closest = std::min(closest, distance(p, crossing.point));
      EXPECT_LT(closest, spacing);
    }
  }
}

TEST(SurfaceCandidates, RefusesASpacingThatMakesNoSense) {
  const std::unique_ptr<Domain> domain =
      make_level_set(test::noisy_ball<float>(kSize, Frame()), {50, InsideSide::above, {}});
  for (const double spacing : {0.0, -1.0, 1e-9, std::numeric_limits<double>::quiet_NaN()}) {
    try {
      domain->surface_candidates(spacing, [](const Point&) {});
      ADD_FAILURE() << spacing << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), "usage.spacing");
      EXPECT_EQ(error.fault(), Fault::usage);
    }
  }
}

}  // namespace
}  // namespace scantet
