#include "scantet/size_options/boundary_look.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scantet/base/parallel.h"
#include "scantet/domain/analytic.h"

namespace scantet {
namespace {

constexpr double kPi = 3.141592653589793;

/// A ball of radius 10 whose surface has waves.
class WavyBall final : public Domain {
 public:
  explicit WavyBall(double height_mm, double length_mm) : height_mm_(height_mm), length_mm_(length_mm) {}
  Box bounds() const override { return {{-12, -12, -12}, {12, 12, 12}}; }
  Region region_at(const Point& p) const override { return Region{height_at(p) > 0}; }
  void crossings(const Segment& segment, Crossings& out) const override {
    constexpr int kSteps = 400;
    out.clear();
    Point last = segment.source;
    for (int n = 1; n <= kSteps; ++n) {
      const Point p = n == kSteps ? segment.target : lerp(segment.source, segment.target, double(n) / kSteps);
      const double a = height_at(last);
      const double b = height_at(p);
      if ((a > 0) != (b > 0)) out.push_back({lerp(last, p, a / (a - b)), Region{a > 0}, Region{b > 0}});
      last = p;
    }
  }

 private:
  double height_at(const Point& p) const {
    const auto wave = [&](double x) { return std::sin(2 * kPi * x / length_mm_); };
    return 10 - length(Vec{p.x, p.y, p.z}) + height_mm_ * wave(p.x) * wave(p.y) * wave(p.z);
  }
  double height_mm_;
  double length_mm_;
};

BoundaryLook look(const Domain& domain, const SizingField& size, std::optional<double> finest_mm = {}) {
  Progress progress;
  return look_at_boundary(domain, size, finest_mm, progress).value();
}

TEST(BoundaryLook, CubesOnASphereGoWithItsAreaOverTheSizeSquared) {
  const auto ball = make_sphere({}, 10);
  const double area = 4 * kPi * 100;
  for (const double size : {0.5, 1.0, 2.0}) {
    const BoundaryLook found = look(*ball, UniformSize(size));
    EXPECT_GT(found.cubes * size * size, 1.2 * area);  // 1.5 times the area, on average over directions
    EXPECT_LT(found.cubes * size * size, 1.7 * area);
    EXPECT_EQ(found.bent, 0);
  }
}

TEST(BoundaryLook, ASizeTooSmallToSeeIsScaledUp) {
  const double at_1 = look(*make_sphere({}, 10), UniformSize(1)).cubes;
  EXPECT_NEAR(look(*make_sphere({}, 10), UniformSize(1e-3)).cubes / (1e6 * at_1), 1, 0.1);
  EXPECT_GT(look(*make_sphere({}, 10), UniformSize(1e-200)).cubes, 1e300);
}

TEST(BoundaryLook, SizesMayVary) {
  const auto ball = make_sphere({}, 10);
  const FinerSize finer(std::make_shared<UniformSize>(2), {{{10, 0, 0}, 0.25}});
  const double cubes = look(*ball, finer).cubes;
  EXPECT_GT(cubes, 1.05 * look(*ball, UniformSize(2)).cubes);
  EXPECT_LT(cubes, look(*ball, UniformSize(0.25)).cubes);
}

TEST(BoundaryLook, RoughCubesAreBent) {
  const BoundaryLook smooth = look(WavyBall(0, 1.5), UniformSize(3), 0.5);
  const BoundaryLook rough = look(WavyBall(0.8, 1.5), UniformSize(3), 0.5);
  EXPECT_EQ(smooth.bent, 0);
  EXPECT_GT(rough.bent, 300);
}

TEST(BoundaryLook, IsTheSameForAnyNumberOfThreads) {
  const auto with = [](std::size_t threads) {
    BoundaryLook found;
    with_threads(threads, [&] { found = look(WavyBall(0.8, 1.5), UniformSize(1.3), 0.5); });
    return std::pair(found.cubes, found.bent);
  };
  EXPECT_EQ(with(1), with(3));
}

}  // namespace
}  // namespace scantet
