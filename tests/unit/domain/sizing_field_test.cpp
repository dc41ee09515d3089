#include "scantet/domain/sizing_field.h"

#include <gtest/gtest.h>

#include <random>

namespace scantet {
namespace {

std::vector<FinerPlace> random_places(std::size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-20, 20);
  std::uniform_real_distribution<double> size(0.2, 2.5);  // some are no finer than the rest
  std::vector<FinerPlace> places;
  for (std::size_t i = 0; i < count; ++i) {
    places.push_back({{coordinate(random), coordinate(random), coordinate(random)}, size(random)});
  }
  return places;
}

TEST(FinerSize, IsTheLeastOfAllPlaces) {
  const std::vector<FinerPlace> places = random_places(1000);
  const FinerSize size(std::make_shared<UniformSize>(2), places);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> coordinate(-25, 25);
  int finer = 0;
  for (int i = 0; i < 5000; ++i) {
    const Point p{coordinate(random), coordinate(random), coordinate(random)};
    double least = 2;
    for (const FinerPlace& place : places) least = std::min(least, place.size_mm + distance(p, place.point));
    EXPECT_EQ(size.size_at(p), least);
    finer += least < 2 ? 1 : 0;
  }
  EXPECT_GT(finer, 50);
}

TEST(FinerSize, UpToASizeIsTheLesserOfBoth) {
  const auto finer = std::make_shared<FinerSize>(std::make_shared<UniformSize>(2), random_places(1000));
  const LeastSize both({finer, std::make_shared<UniformSize>(1.5)});
  std::mt19937 random(10);
  std::uniform_real_distribution<double> coordinate(-25, 25);
  std::uniform_real_distribution<double> most(-0.1, 3);
  for (int i = 0; i < 5000; ++i) {
    const Point p{coordinate(random), coordinate(random), coordinate(random)};
    const double most_mm = most(random);
    EXPECT_EQ(finer->size_up_to(p, most_mm), std::min(finer->size_at(p), most_mm));
    EXPECT_EQ(both.size_up_to(p, most_mm), std::min(both.size_at(p), most_mm));
  }
}

TEST(FinerSize, DownToASizeIsTheGreaterOfBoth) {
  const auto finer = std::make_shared<FinerSize>(std::make_shared<UniformSize>(2), random_places(1000));
  const LeastSize both({finer, std::make_shared<UniformSize>(1.5)});
  for (const FinerPlace& place : random_places(200)) {
    for (const double least_mm : {0.0, 0.3, 1.0, 1.7, 5.0}) {
      EXPECT_EQ(finer->size_down_to(place.point, least_mm), std::max(finer->size_at(place.point), least_mm));
      EXPECT_EQ(both.size_down_to(place.point, least_mm), std::max(both.size_at(place.point), least_mm));
    }
  }
}

TEST(FinerSize, HasItsLeastSizeAtAPlace) {
  const FinerSize size(std::make_shared<UniformSize>(2), {{{1, 2, 3}, 0.5}, {{5, 5, 5}, 1}});
  EXPECT_EQ(size.min_size(), 0.5);
  EXPECT_EQ(size.size_at({1, 2, 3}), 0.5);
  EXPECT_EQ(size.size_at({5, 5, 5}), 1);
  EXPECT_EQ(size.size_at({-1e12, 0, 1e12}), 2);
}

TEST(FinerSize, WithoutPlacesIsUniform) {
  const FinerSize size(std::make_shared<UniformSize>(3), {});
  EXPECT_EQ(size.min_size(), 3);
  EXPECT_EQ(size.size_at({1, 1, 1}), 3);
}

TEST(FinerSize, IsLipschitz) {
  const FinerSize size(std::make_shared<UniformSize>(2), random_places(50));
  std::mt19937 random(9);
  std::uniform_real_distribution<double> coordinate(-22, 22);
  std::uniform_real_distribution<double> step(-0.3, 0.3);
  for (int i = 0; i < 5000; ++i) {
    const Point p{coordinate(random), coordinate(random), coordinate(random)};
    const Point q = p + Vec{step(random), step(random), step(random)};
    EXPECT_LE(std::abs(size.size_at(p) - size.size_at(q)), distance(p, q) + 1e-12);
  }
}

/// 1 mm at x = 0, growing to the right; bounds no tets.
class Slope final : public SizingField {
 public:
  double size_at(const Point& p) const override { return 1 + std::max(0.0, 0.5 * p.x); }
  double min_size() const override { return 1; }
  double usual_size() const override { return 4; }
  bool bounds_tets() const override { return false; }
};

TEST(FinerSize, OverlaysAnyField) {
  const FinerSize size(std::make_shared<Slope>(), {{{8, 0, 0}, 0.5}});
  EXPECT_EQ(size.size_at({8, 0, 0}), 0.5);
  EXPECT_EQ(size.size_at({10, 0, 0}), 2.5);
  EXPECT_EQ(size.size_at({20, 0, 0}), 11);
  EXPECT_EQ(size.size_at({-5, 0, 0}), 1);
  EXPECT_EQ(size.min_size(), 0.5);
  EXPECT_EQ(size.usual_size(), 4);
  EXPECT_FALSE(size.bounds_tets());
}

TEST(LeastSize, IsTheLeastOfItsFields) {
  const LeastSize size({std::make_shared<UniformSize>(3), std::make_shared<Slope>()});
  EXPECT_EQ(size.size_at({2, 0, 0}), 2);
  EXPECT_EQ(size.size_at({20, 0, 0}), 3);
  EXPECT_EQ(size.min_size(), 1);
  EXPECT_EQ(size.usual_size(), 3);
  EXPECT_TRUE(size.bounds_tets());
}

}  // namespace
}  // namespace scantet
