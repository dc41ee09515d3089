#include "scantet/size_options/mesh_prediction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scantet/domain/analytic.h"
#include "unit/thin_plate.h"

namespace scantet {
namespace {

/// A ball of radius 10 that knows its volume, or does not, and announces a narrow place.
class Ball final : public Domain {
 public:
  explicit Ball(double volume_mm3) : volume_mm3_(volume_mm3) {}
  Box bounds() const override { return {{-10, -10, -10}, {10, 10, 10}}; }
  Region region_at(const Point& p) const override { return ball_->region_at(p); }
  void crossings(const Segment& segment, Crossings& out) const override { ball_->crossings(segment, out); }
  std::vector<Component> components() const override {
    return {{1, {}, bounds(), volume_mm3_}, {kOutside, {}, bounds(), 1e6}};
  }
  void size_hints(const SizeHintSink& sink) const override { sink({{10, 0, 0}, 1}); }

 private:
  std::unique_ptr<Domain> ball_ = make_sphere({}, 10);
  double volume_mm3_;
};

MeshFeatures features_of(const Domain& domain, const SizingField& size, double alpha = 1) {
  Progress progress;
  return find_features(domain, size, alpha, std::nullopt, progress).value();
}

TEST(MeshPrediction, TheInsideIsCountedInCubesOfTheSize) {
  EXPECT_DOUBLE_EQ(find_inside(Ball(4000), UniformSize(2)).inside, 500);  // a cavity's volume does not count
  EXPECT_DOUBLE_EQ(find_inside(Ball(0), UniformSize(2)).inside, 0.05 * 8000 / 8) << "roughly, of an unknown volume";
  const double volume = 4 * std::numbers::pi / 3 * 1000;
  EXPECT_NEAR(features_of(Ball(0), UniformSize(2)).inside, volume / 8, 0.02 * volume / 8);
  const FinerSize finer(std::make_shared<UniformSize>(2), {{{0, 0, 0}, 0.5}});
  EXPECT_GT(find_inside(Ball(0), finer).inside, features_of(Ball(0), UniformSize(2)).inside);
}

TEST(MeshPrediction, TheInsideOfAThinObjectIsItsVolumeWhereSizesVary) {
  const test::ThinPlate plate;
  const double cubes = test::ThinPlate::kVolume_mm3 / 8;
  EXPECT_NEAR(find_inside(plate, UniformSize(2)).inside, cubes, 1e-9);
  const FinerSize elsewhere(std::make_shared<UniformSize>(2), {{{0, 0, 9}, 0.01}});
  EXPECT_NEAR(find_inside(plate, elsewhere).inside, cubes, 1e-9) << "a place where it is not makes no difference";
  const FinerSize finer(std::make_shared<UniformSize>(2), {{{0, 0, 0.5}, 0.5}});
  EXPECT_GT(find_inside(plate, finer).inside, cubes);
  EXPECT_LT(find_inside(plate, finer).inside, 64 * cubes);
  EXPECT_EQ(find_inside(test::ThinPlate(false), finer).inside, 0) << "nothing is known of it";
  EXPECT_GT(features_of(test::ThinPlate(false), finer).cubes, 18 * 18 / 4);
}

TEST(MeshPrediction, NarrowPlacesCountBesideTheSizeOnTheBoundary) {
  EXPECT_NEAR(features_of(Ball(0), UniformSize(2)).narrow, std::sqrt(std::log2(0.92 * 2 / 0.5)), 1e-12);
  EXPECT_EQ(features_of(Ball(0), UniformSize(0.5)).narrow, 0);
  EXPECT_EQ(features_of(Ball(0), UniformSize(2), 0.25).narrow, 0) << "alpha 0.25: the boundary is finer";
  EXPECT_GT(features_of(Ball(0), UniformSize(2), 0.25).cubes, 10 * features_of(Ball(0), UniformSize(2)).cubes);
}

TEST(MeshPrediction, EverythingCosts) {
  const MeshPrediction none = predict({});
  for (const MeshFeatures& features : {MeshFeatures{1e6, 0, 0, 0}, MeshFeatures{0, 1e6, 0, 0},
                                       MeshFeatures{0, 0, 1e6, 0}, MeshFeatures{0, 0, 0, 1e6}}) {
    const MeshPrediction some = predict(features);
    EXPECT_GE(some.vertices, none.vertices);
    EXPECT_GE(some.tets, none.tets);
    EXPECT_GE(some.bytes, none.bytes);
    EXPECT_GE(some.processor_s, none.processor_s);
  }
  const MeshPrediction mesh = predict({1e6, 1e5, 0, 0});
  EXPECT_GT(mesh.tets, 4 * mesh.vertices);
  EXPECT_LT(mesh.tets, 7 * mesh.vertices);
  EXPECT_DOUBLE_EQ(mesh.seconds(1), mesh.processor_s);
  EXPECT_LT(mesh.seconds(2), mesh.seconds(1));
}

}  // namespace
}  // namespace scantet
