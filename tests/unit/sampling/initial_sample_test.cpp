#include "scantet/sampling/initial_sample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scantet/base/error.h"
#include "scantet/base/parallel.h"
#include "scantet/domain/analytic.h"
#include "unit/counting_domain.h"
#include "unit/sampling/distance_to.h"

namespace scantet {
namespace {

using test::distance_to;

std::vector<Point> sample_of(const Domain& domain, double size_mm, std::uint64_t seed = 0, double alpha = 1) {
  Progress progress;
  return initial_sample(domain, UniformSize(size_mm), {alpha, seed}, progress);
}

TEST(InitialSample, LiesOnTheBoundary) {
  const auto torus = make_torus({}, 10, 3);
  for (const Point& p : sample_of(*torus, 1)) EXPECT_LE(torus->residual_at(p).value(), 1e-9);
}

TEST(InitialSample, IsSparse) {
  for (const double alpha : {0.5, 1.0}) {
    const auto sample = sample_of(*make_torus({}, 10, 4), 2, 0, alpha);
    for (std::size_t i = 0; i < sample.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) EXPECT_GE(distance(sample[i], sample[j]), 0.75 * 0.92 * alpha * 2);
    }
  }
}

TEST(InitialSample, CoversTheBoundary) {
  const auto sphere = make_sphere({}, 10);
  const auto sample = sample_of(*sphere, 2);
  sphere->surface_candidates(0.7, [&](const Point& p) { EXPECT_LE(distance_to(sample, p), 2); });
}

/// Fine at a point of the boundary, growing from there.
class FineAtAPoint final : public SizingField {
 public:
  explicit FineAtAPoint(const Point& place) : place_(place) {}
  double size_at(const Point& p) const override { return std::min(4.0, 0.05 + distance(p, place_)); }
  double min_size() const override { return 0.05; }
  double usual_size() const override { return 4; }

 private:
  Point place_;
};

TEST(InitialSample, LooksCloserOnlyWhereSizesAreSmall) {
  const auto sphere = make_sphere({}, 20);
  const test::CountingDomain counting(*sphere);
  const FineAtAPoint size({20, 0, 0});
  Progress progress;
  const auto sample = initial_sample(counting, size, {1, 0}, progress);
  sphere->surface_candidates(0.7, [&](const Point& p) { EXPECT_LE(distance_to(sample, p), 1.1 * size.size_at(p)); });
  for (int i = 0; i < 100; ++i) {  // around the place
    const double angle = 0.0001 * i * i;
    const Point p{20 * std::cos(angle), 20 * std::sin(angle), 0};
    EXPECT_LE(distance_to(sample, p), 1.1 * size.size_at(p)) << angle;
  }
  EXPECT_LT(sample.size(), 3000U);
  EXPECT_LT(counting.lines, 1'500'000U) << "at the least size everywhere it would be nine million";
}

/// Nearest neighbours are as far apart as in a hexagonal grid of as many points, times a share that a random sample
/// does not reach.
TEST(InitialSample, IsEven) {
  const auto sphere = make_sphere({}, 20);
  const auto sample = sample_of(*sphere, 2);
  double sum = 0;
  for (const Point& p : sample) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Point& q : sample) nearest = p == q ? nearest : std::min(nearest, distance(p, q));
    sum += nearest;
  }
  const auto count = static_cast<double>(sample.size());
  const double hexagonal = std::sqrt(4 * M_PI * 400 / count * 2 / std::sqrt(3.0));
  EXPECT_GT(sum / count, 0.84 * hexagonal);
}

TEST(InitialSample, HasPointsOnEveryBoundaryComponent) {
  const auto shell = make_shell({}, 3, 10);
  int inner = 0;
  for (const Point& p : sample_of(*shell, 4)) inner += length(p) < 5 ? 1 : 0;
  EXPECT_GE(inner, 4);
}

TEST(InitialSample, DependsOnTheSeedOnly) {
  const auto sphere = make_sphere({}, 10);
  EXPECT_EQ(sample_of(*sphere, 2, 7), sample_of(*sphere, 2, 7));
  EXPECT_NE(sample_of(*sphere, 2, 7), sample_of(*sphere, 2, 8));
}

TEST(InitialSample, DoesNotDependOnThreads) {
  const auto torus = make_torus({}, 10, 4);
  std::vector<std::vector<Point>> samples;
  for (const std::size_t threads : {1, 2, 8}) {
    with_threads(threads, [&] { samples.push_back(sample_of(*torus, 0.7)); });
  }
  EXPECT_GT(samples[0].size(), 2000U);
  EXPECT_EQ(samples[0], samples[1]);
  EXPECT_EQ(samples[0], samples[2]);
}

/// Another domain with its candidates backwards and a feature somewhere on its boundary.
class Backwards final : public Domain {
 public:
  Backwards(const Domain& domain, const SizeHint& feature, bool backwards)
      : domain_(domain), feature_(feature), backwards_(backwards) {}
  Box bounds() const override { return domain_.bounds(); }
  Region region_at(const Point& p) const override { return domain_.region_at(p); }
  void crossings(const Segment& segment, Crossings& out) const override { domain_.crossings(segment, out); }
  void surface_candidates(double spacing_mm, const PointSink& sink) const override {
    std::vector<Point> points;
    domain_.surface_candidates(spacing_mm, [&](const Point& p) { points.push_back(p); });
    if (backwards_) std::reverse(points.begin(), points.end());
    for (const Point& p : points) sink(p);
  }
  void size_hints(const SizeHintSink& sink) const override { sink(feature_); }

 private:
  const Domain& domain_;
  SizeHint feature_;
  bool backwards_;
};

TEST(InitialSample, DoesNotDependOnTheOrderOfTheCandidates) {
  const auto sphere = make_sphere({}, 10);
  const SizeHint feature{{10, 0, 0}, 0.5};
  EXPECT_EQ(sample_of(Backwards(*sphere, feature, false), 2), sample_of(Backwards(*sphere, feature, true), 2));
}

TEST(InitialSample, IsFinerNearAFeature) {
  const auto sphere = make_sphere({}, 10);
  const auto sample = sample_of(Backwards(*sphere, {{10, 0, 0}, 0.5}, false), 2);
  EXPECT_LE(distance_to(sample, {10, 0, 0}), 0.5);
  const auto near = std::count_if(sample.begin(), sample.end(), [](const Point& p) { return p.x > 9.9; });
  const auto far = std::count_if(sample.begin(), sample.end(), [](const Point& p) { return p.x < -9.9; });
  EXPECT_GE(near, 3 * far);
}

TEST(InitialSample, OfADomainSmallerThanTheSizeSpansSpace) {
  EXPECT_GE(sample_of(*make_sphere({}, 0.1), 0.05).size(), 4U);
  EXPECT_GE(sample_of(*make_sphere({}, 1), 100).size(), 1U);
}

/// A domain with nothing in it.
class Nothing final : public Domain {
 public:
  Box bounds() const override {
    Box box;
    box.extend({0, 0, 0});
    box.extend({1, 1, 1});
    return box;
  }
  Region region_at(const Point&) const override { return kOutside; }
  void crossings(const Segment&, Crossings& out) const override { out.clear(); }
};

TEST(InitialSample, OfNothingIsAnError) {
  try {
    sample_of(Nothing(), 0.5);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), "input.empty");
    EXPECT_EQ(error.fault(), Fault::input);
  }
}

}  // namespace
}  // namespace scantet
