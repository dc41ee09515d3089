#include <gtest/gtest.h>

#include <algorithm>

#include "scantet/base/parallel.h"
#include "scantet/domain/analytic.h"
#include "scantet/sampling/sample_relaxation_impl.h"

namespace scantet::engine {
namespace {

constexpr double kRadius_mm = 1;

/// Random points of the torus, a radius apart at least.
LargeVector<Dart> random_sample(const Domain& torus) {
  std::vector<Dart> darts;
  torus.surface_candidates(0.25, [&](const Point& p) {
    const auto mixed = static_cast<std::uint64_t>(1e6 * (p.x + 20)) * 2654435761U ^
                       static_cast<std::uint64_t>(1e6 * (p.y + 20)) * 40503U ^
                       static_cast<std::uint64_t>(1e6 * (p.z + 20)) * 1000003U;
    darts.push_back({p, kRadius_mm, mixed * 0x9e3779b97f4a7c15ULL});
  });
  return throw_darts(darts, 1);
}

/// The mean distance from a place of the torus to the nearest point: how well these cover it.
double mean_gap(const Domain& torus, std::span<const Dart> sample) {
  double sum = 0;
  int count = 0;
  torus.surface_candidates(0.7, [&](const Point& p) {
    double squared = 1e300;
    for (const Dart& dart : sample) squared = std::min(squared, squared_distance(dart.point, p));
    sum += squared;
    ++count;
  });
  return sum / count;
}

class SampleRelaxation : public testing::Test {
 protected:
  std::unique_ptr<Domain> torus_ = make_torus({}, 8, 3);
  LargeVector<Dart> sample_ = random_sample(*torus_);
};

TEST_F(SampleRelaxation, PointsStayOnTheBoundaryAndNearTheirPlace) {
  const std::vector<Point> before = points_of(sample_);
  relax_sample(*torus_, sample_);
  std::size_t moved = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Point& p = sample_[i].point;
    EXPECT_NEAR(std::hypot(std::hypot(p.x, p.y) - 8, p.z), 3, 1e-9);
    EXPECT_LT(distance(p, before[i]), 4 * 0.3 * kRadius_mm + 0.5 * kRadius_mm);
    moved += p != before[i] ? 1 : 0;
  }
  EXPECT_GT(moved, before.size() * 9 / 10);
}

TEST_F(SampleRelaxation, PointsCoverTheBoundaryMoreEvenly) {
  const double before = mean_gap(*torus_, sample_);
  relax_sample(*torus_, sample_);
  EXPECT_LT(mean_gap(*torus_, sample_), 0.95 * before);
}

TEST_F(SampleRelaxation, FixedPointsAndLonelyOnesStay) {
  for (std::size_t i = 0; i < sample_.size(); i += 2) sample_[i].fixed = true;
  const std::vector<Point> before = points_of(sample_);
  relax_sample(*torus_, sample_);
  for (std::size_t i = 0; i < sample_.size(); i += 2) EXPECT_EQ(sample_[i].point, before[i]);
  std::vector<Dart> two{{{11, 0, 0}, 1, 0}, {{-11, 0, 0}, 1, 1}};
  relax_sample(*torus_, two);
  EXPECT_EQ(two[0].point, (Point{11, 0, 0}));
}

TEST_F(SampleRelaxation, IsTheSameForAnyNumberOfThreads) {
  LargeVector<Dart> again = sample_;
  with_threads(1, [&] { relax_sample(*torus_, sample_); });
  with_threads(4, [&] { relax_sample(*torus_, again); });
  EXPECT_EQ(points_of(again), points_of(sample_));
}

}  // namespace
}  // namespace scantet::engine
