#include "scantet/sizing/feature_size.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "scantet/base/parallel.h"
#include "scantet/domain/analytic.h"

namespace scantet {
namespace {

/// Another domain, stretched: crossings of a line are those of the line's image.
class Stretched final : public Domain {
 public:
  Stretched(std::unique_ptr<Domain> domain, const Vec& factors) : domain_(std::move(domain)), factors_(factors) {}
  Box bounds() const override { return {out(domain_->bounds().min), out(domain_->bounds().max)}; }
  Region region_at(const Point& p) const override { return domain_->region_at(in(p)); }
  void crossings(const Segment& s, Crossings& found) const override {
    domain_->crossings({in(s.source), in(s.target)}, found);
    for (Crossing& crossing : found) crossing.point = out(crossing.point);
  }

 private:
  Point in(const Point& p) const { return {p.x / factors_.x, p.y / factors_.y, p.z / factors_.z}; }
  Point out(const Point& p) const { return {p.x * factors_.x, p.y * factors_.y, p.z * factors_.z}; }
  std::unique_ptr<Domain> domain_;
  Vec factors_;
};

/// A cube of side 2 around the origin.
class Cube final : public Domain {
 public:
  Box bounds() const override { return {{-1.05, -1.05, -1.05}, {1.05, 1.05, 1.05}}; }
  Region region_at(const Point& p) const override {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < 1 ? 1 : kOutside;
  }
  void crossings(const Segment& s, Crossings& found) const override {
    found.clear();
    double enter = 0;
    double leave = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const double from = s.source[axis];
      const double along = s.target[axis] - from;
      if (along == 0) {
        if (std::abs(from) >= 1) return;
        continue;
      }
      const double a = (-1 - from) / along;
      const double b = (1 - from) / along;
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (enter >= leave) return;
    if (region_at(s.source) == kOutside) found.push_back({lerp(s.source, s.target, enter), kOutside, 1});
    if (region_at(s.target) == kOutside) found.push_back({lerp(s.source, s.target, leave), 1, kOutside});
  }
};

/// Holds the sizes against the true ones: the largest error, relative.
double worst_error(const Domain& domain, double spacing_mm, const std::function<double(const Point&)>& truth) {
  Progress progress;
  const FeatureSizes found = feature_sizes(domain, {std::nullopt, spacing_mm}, progress);
  EXPECT_GT(found.sizes.size(), 1000U);
  double worst = 0;
  for (const Cone& cone : found.sizes) {
    worst = std::max(worst, std::abs(cone.height_mm / truth(cone.apex) - 1));
  }
  return worst;
}

TEST(FeatureSize, OfASphereIsItsRadius) {
  EXPECT_LE(worst_error(*make_sphere({1, 2, 3}, 10), 0.5, [](const Point&) { return 10.0; }), 0.1);
}

TEST(FeatureSize, OfATorusIsThatOfTheTubeOrOfTheHole) {
  for (const double tube : {2.0, 6.0}) {  // ring 8: the tube is narrower than the hole, and wider
    const auto truth = [tube](const Point& p) { return std::min(tube, std::hypot(p.x, p.y)); };
    EXPECT_LE(worst_error(*make_torus({0, 0, 0}, 8, tube), 0.4, truth), 0.1) << tube;
  }
}

TEST(FeatureSize, OfAProlateEllipsoidIsTheDistanceToASegment) {
  const Stretched ellipsoid(make_sphere({0, 0, 0}, 5), {2, 1, 1});  // medial axis: |x| ≤ a - b²/a
  const auto truth = [](const Point& p) {
    const double beyond = std::max(0.0, std::abs(p.x) - (10 - 25.0 / 10));
    return std::sqrt(beyond * beyond + p.y * p.y + p.z * p.z);
  };
  EXPECT_LE(worst_error(ellipsoid, 0.3, truth), 0.13);
}

TEST(FeatureSize, OfAnOblateEllipsoidIsTheDistanceToADisc) {
  const Stretched ellipsoid(make_sphere({0, 0, 0}, 5), {2, 2, 1});
  const auto truth = [](const Point& p) {
    const double beyond = std::max(0.0, std::hypot(p.x, p.y) - (10 - 25.0 / 10));
    return std::hypot(beyond, p.z);
  };
  EXPECT_LE(worst_error(ellipsoid, 0.3, truth), 0.12);
}

TEST(FeatureSize, LipschitzRadiusOfASphereFollowsFromTheAngle) {
  Progress progress;
  const double angle = 0.5;  // radians
  const FeatureSizes found = feature_sizes(*make_sphere({0, 0, 0}, 10), {std::tan(angle), 0.3}, progress);
  const double truth = 2 * 10 * std::sin(angle / 2);
  for (const Cone& cone : found.sizes) {
    EXPECT_GE(cone.height_mm, truth / 1.5);
    EXPECT_LE(cone.height_mm, 1.15 * truth);
  }
}

TEST(FeatureSize, LipschitzRadiusIsLargeAtEdgesWhereTheMedialAxisIsNear) {
  Progress progress;
  const Cube cube;
  double radius = 10;
  double medial = 10;
  const auto near_an_edge = [](const Point& p) {
    return std::abs(p.z) < 0.3 && std::abs(p.x) > 0.9 && std::abs(p.y) > 0.9;
  };
  for (const Cone& cone : feature_sizes(cube, {1.2, 0.03}, progress).sizes) {
    if (near_an_edge(cone.apex)) radius = std::min(radius, cone.height_mm);
  }
  for (const Cone& cone : feature_sizes(cube, {std::nullopt, 0.03}, progress).sizes) {
    if (near_an_edge(cone.apex)) medial = std::min(medial, cone.height_mm);
  }
  EXPECT_GE(radius, 0.5);
  EXPECT_LE(medial, 0.15);
}

TEST(FeatureSize, DoesNotDependOnThreads) {
  const auto torus = make_torus({0, 0, 0}, 8, 3);
  for (const std::optional<double> k : {std::optional<double>(), std::optional<double>(0.5)}) {
    std::vector<Cone> first;
    for (const std::size_t threads : {1, 2, 8}) {
      with_threads(threads, [&] {
        Progress progress;
        const FeatureSizes found = feature_sizes(*torus, {k, 0.5}, progress);
        if (first.empty()) first = found.sizes;
        ASSERT_EQ(found.sizes.size(), first.size());
        for (std::size_t i = 0; i < first.size(); ++i) {
          EXPECT_EQ(found.sizes[i].apex, first[i].apex);
          EXPECT_EQ(found.sizes[i].height_mm, first[i].height_mm);
        }
      });
    }
  }
}

}  // namespace
}  // namespace scantet
