#include "scantet/size_options/vertex_estimate.h"

#include <gtest/gtest.h>

#include "scantet/domain/analytic.h"

namespace scantet {
namespace {

constexpr double kPi = 3.141592653589793;

/// A ball of radius 10 that knows its volume, or does not.
class Ball final : public Domain {
 public:
  explicit Ball(double volume_mm3) : volume_mm3_(volume_mm3) {}
  Box bounds() const override { return {{-10, -10, -10}, {10, 10, 10}}; }
  Region region_at(const Point& p) const override { return ball_->region_at(p); }
  void crossings(const Segment& segment, Crossings& out) const override { ball_->crossings(segment, out); }
  std::vector<Component> components() const override {
    return {{1, {}, bounds(), volume_mm3_}, {kOutside, {}, bounds(), 1e6}};
  }

 private:
  std::unique_ptr<Domain> ball_ = make_sphere({}, 10);
  double volume_mm3_;
};

TEST(VertexEstimate, OneForEachCubeOfTheSize) {
  EXPECT_DOUBLE_EQ(vertices_of_size(Ball(4000), 2), 500);  // a cavity's volume does not count
}

TEST(VertexEstimate, ATwentiethOfTheBoxStandsForAnUnknownVolume) {
  EXPECT_DOUBLE_EQ(vertices_of_size(Ball(0), 2), 0.05 * 8000 / 8);
}

TEST(VertexEstimate, InsideIsIntegratedOverTheRegions) {
  const double volume = 4 * kPi / 3 * 1000;
  EXPECT_NEAR(vertices_inside(Ball(0), UniformSize(2)), volume / 8, 0.02 * volume / 8);
  const FinerSize finer(std::make_shared<UniformSize>(2), {{{0, 0, 0}, 0.5}});
  EXPECT_GT(vertices_inside(Ball(0), finer), vertices_inside(Ball(0), UniformSize(2)));
}

TEST(VertexEstimate, OnTheBoundaryOneForEachSquareOfTheSize) {
  EXPECT_DOUBLE_EQ(vertices_on_boundary({{{}, 1}, {{}, 0.5}}, 1), 5);
  EXPECT_EQ(vertices_on_boundary({}, 1), 0);
}

}  // namespace
}  // namespace scantet
