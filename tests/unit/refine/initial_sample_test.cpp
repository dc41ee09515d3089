#include "scantet/refine/initial_sample.h"

#include <gtest/gtest.h>

#include "scantet/base/error.h"
#include "scantet/domain/analytic.h"

namespace scantet {
namespace {

std::vector<Point> sample_of(const Domain& domain, double size_mm, std::uint64_t seed = 0) {
  Progress progress;
  return initial_sample(domain, UniformSize(size_mm), {1, seed}, progress);
}

TEST(InitialSample, LiesOnTheBoundary) {
  const auto torus = make_torus({}, 10, 3);
  for (const Point& p : sample_of(*torus, 1)) EXPECT_LE(torus->residual_at(p).value(), 1e-9);
}

TEST(InitialSample, IsSparse) {
  const auto sample = sample_of(*make_sphere({}, 10), 2);
  for (std::size_t i = 0; i < sample.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_GE(distance(sample[i], sample[j]), 0.95 * 2);
  }
}

TEST(InitialSample, CoversTheBoundary) {
  const auto sphere = make_sphere({}, 10);
  const auto sample = sample_of(*sphere, 2);
  sphere->surface_candidates(0.7, [&](const Point& p) {
    double nearest = 1e300;
    for (const Point& q : sample) nearest = std::min(nearest, distance(p, q));
    EXPECT_LE(nearest, 2.4);
  });
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
