// Sizes in a shell of known thickness, and regions by their names.
#include "scantet/size_options/layer_sizes.h"

#include <gtest/gtest.h>

#include "error_code.h"
#include "scantet/size_options/region_names.h"
#include "unit/nested_balls.h"

namespace scantet {
namespace {

class NamedBalls final : public test::NestedBalls {
 public:
  NamedBalls() : NestedBalls(5, 8) {}
  std::string name_of_region(Region region) const override { return region == 1 ? "shell" : "core"; }
};

std::vector<Cone> sizes_of(int layers, const std::set<Region>& regions, double size_mm, double thinnest_mm = 0.5) {
  const NamedBalls balls;
  return layer_sizes(balls, {layers, regions, 1, thinnest_mm}, UniformSize(size_mm), Progress());
}

TEST(LayerSizes, AShellGetsAShareOfItsThickness) {
  for (const int layers : {2, 3, 5}) {
    const std::vector<Cone> sizes = sizes_of(layers, {1}, 4);
    ASSERT_GT(sizes.size(), 500U);
    for (const Cone& size : sizes) {
      EXPECT_NEAR(size.height_mm, 0.8 * 3 / (2.0 * (layers - 1)), 0.1 * size.height_mm);
      EXPECT_GT(length(size.apex), 4.9);
      EXPECT_LT(length(size.apex), 8.1);
    }
  }
}

TEST(LayerSizes, WhatIsThickOrSmallEnoughIsLeftAsItIs) {
  EXPECT_TRUE(sizes_of(2, {1}, 1).empty()) << "a size of 1 mm puts two tets across 3 mm";
  EXPECT_TRUE(sizes_of(2, {2}, 3.5).empty()) << "the core is 10 mm thick";
  EXPECT_TRUE(sizes_of(2, {1}, 4, 4).empty()) << "thinner than what is looked at";
  EXPECT_TRUE(sizes_of(2, {}, 4).empty());
}

SizePlan plan_of(const std::vector<std::string>& region_sizes, const std::string& layers = "") {
  SizeOptions options;
  options.region_sizes = region_sizes;
  options.layers = layers;
  return plan_sizes(options);
}

TEST(RegionNames, AreNumbersInTheEnd) {
  const NamedBalls balls;
  const SizePlan plan = plan_with_numbers(plan_of({"shell=1.5", "2=3"}), balls);
  EXPECT_EQ(plan.regions, (std::map<Region, double>{{1, 1.5}, {2, 3}}));
  EXPECT_TRUE(plan.named_regions.empty());
  EXPECT_EQ(regions_in_layers(plan_of({}, "2").layers, balls), (std::set<Region>{1, 2}));
  EXPECT_EQ(regions_in_layers(plan_of({}, "3,core").layers, balls), (std::set<Region>{2}));
  EXPECT_EQ(regions_in_layers(plan_of({}, "3,1,core").layers, balls), (std::set<Region>{1, 2}));
  EXPECT_EQ(plan_of({}, "3,1").layers.layers, 3);
}

TEST(RegionNames, WhatIsNotThereIsRefused) {
  const NamedBalls balls;
  const auto size_code = [&](const std::vector<std::string>& sizes) {
    return test::error_code([&] { plan_with_numbers(plan_of(sizes), balls); });
  };
  EXPECT_EQ(size_code({"skull=1"}), "usage.region_size");
  EXPECT_EQ(size_code({"shell=1", "1=2"}), "usage.region_size");
  EXPECT_EQ(size_code({"shell=1", "shell=2"}), "usage.region_size");
  EXPECT_EQ(size_code({"shell"}), "usage.region_size");
  EXPECT_EQ(size_code({"=1"}), "usage.region_size");
  for (const char* const layers : {"1", "21", "two", "2.5", "2,", "2,,1", ",1", "-2"}) {
    EXPECT_EQ(test::error_code([&] { plan_of({}, layers); }), "usage.layers") << layers;
  }
  EXPECT_EQ(test::error_code([&] { regions_in_layers(plan_of({}, "2,skull").layers, balls); }), "usage.layers");
}

}  // namespace
}  // namespace scantet
