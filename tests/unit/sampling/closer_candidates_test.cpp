#include <gtest/gtest.h>

#include "scantet/base/parallel.h"
#include "scantet/domain/analytic.h"
#include "scantet/sampling/closer_candidates_impl.h"

namespace scantet::engine {
namespace {

class CloserCandidates : public testing::Test {
 protected:
  static constexpr double kSeen_mm = 2;
  static constexpr double kSteepness = 0.2;

  CloserCandidates() {
    sphere_->surface_candidates(kSeen_mm, [&](const Point& p) { seen_.push_back(p); });
  }
  /// Grows away from a point of the sphere.
  static double spacing_at(const Point& p) { return 0.2 + kSteepness * distance(p, {10, 0, 0}); }
  std::vector<Point> closer(const std::function<double(const Point&)>& spacing, double steepness) const {
    return closer_candidates(*sphere_, seen_, {kSeen_mm, 0.2, steepness, spacing}, 1e6).value();
  }
  static double distance_to(const std::vector<Point>& points, const Point& p) {
    double squared = 1e300;
    for (const Point& q : points) squared = std::min(squared, squared_distance(p, q));
    return std::sqrt(squared);
  }

  std::unique_ptr<Domain> sphere_ = make_sphere({}, 10);
  std::vector<Point> seen_;
};

TEST_F(CloserCandidates, AreOnTheBoundaryAsCloseAsIsAskedForThere) {
  const std::vector<Point> points = closer(spacing_at, kSteepness);
  ASSERT_GT(points.size(), 500U);
  for (const Point& p : points) EXPECT_NEAR(length(p), 10, 1e-9);
  int asked = 0;
  for (int i = 0; i < 4000; ++i) {  // places all over the sphere
    const double z = 2 * (i + 0.5) / 4000 - 1;
    const double angle = i * M_PI * (3 - std::sqrt(5.0));
    const Point p{10 * z, 10 * std::sqrt(1 - z * z) * std::cos(angle), 10 * std::sqrt(1 - z * z) * std::sin(angle)};
    if (spacing_at(p) > 0.6 * kSeen_mm) continue;
    ++asked;
    EXPECT_LE(distance_to(points, p), spacing_at(p));
  }
  EXPECT_GT(asked, 200);
}

TEST_F(CloserCandidates, AreRefusedBeforeTheyTakeAllMemory) {
  const auto tiny = [](const Point&) { return 1e-9; };  // 10^19 lines through a cube
  EXPECT_FALSE(closer_candidates(*sphere_, seen_, {kSeen_mm, 1e-9, 0, tiny}, 1e6));
}

TEST_F(CloserCandidates, AreNoneWhereThoseThereAreWillDo) {
  for (const Point& p : closer(spacing_at, kSteepness)) {
    EXPECT_LE(spacing_at(p), kSeen_mm * (1 + 2 * kSteepness)) << "within a cube of a place that asks for them";
  }
  EXPECT_TRUE(closer([](const Point&) { return 0.9 * kSeen_mm; }, 0).empty());
}

TEST_F(CloserCandidates, AFewFinePlacesDoNotMakeTheWholeFine) {
  const std::size_t graded = closer(spacing_at, kSteepness).size();
  const std::size_t fine = closer([](const Point&) { return 0.2; }, 0).size();
  EXPECT_LT(10 * graded, fine);
  // Three families of lines, each of which meets π r² / s² of them, twice: about 3 · 2 · π · 100 / 0.04.
  EXPECT_NEAR(double(fine), 47'000, 15'000);
}

TEST_F(CloserCandidates, DoNotDependOnThreads) {
  const std::vector<Point> points = closer(spacing_at, kSteepness);
  for (const std::size_t threads : {1, 3}) {
    with_threads(threads, [&] { EXPECT_EQ(closer(spacing_at, kSteepness), points); });
  }
}

}  // namespace
}  // namespace scantet::engine
