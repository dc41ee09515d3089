#include "scantet/size_options/size_choice.h"

#include <gtest/gtest.h>

#include "scantet/base/error.h"
#include "scantet/size_options/affordable_size.h"
#include "unit/nested_balls.h"
#include "unit/thin_plate.h"

namespace scantet {
namespace {

/// Two balls, of radius 10 and, in it, 5; size 2 unless another is asked for.
OpenedDomain opened_balls() {
  OpenedDomain opened;
  opened.domain = std::make_unique<test::NestedBalls>(5, 10);
  opened.default_size_mm = 2;
  opened.default_size_reason = "as this test has it";
  return opened;
}

ChosenSize choose(const SizeOptions& options) {
  Progress progress;
  return choose_size(options, plan_sizes(options), opened_balls(), progress);
}

SizeOptions sizes(const std::string& inside, const std::string& boundary = "", std::vector<std::string> regions = {}) {
  SizeOptions options;
  options.size = inside;
  options.boundary_size = boundary;
  options.region_sizes = std::move(regions);
  return options;
}

TEST(SizeChoice, TheInputsOwnSizeIfNoneIsGiven) {
  const ChosenSize chosen = choose({});
  EXPECT_EQ(chosen.uniform_mm, 2);
  EXPECT_EQ(chosen.text, "2");
  EXPECT_EQ(chosen.notes, (std::vector<std::string>{"no --size given: size 2 mm, as this test has it"}));
}

TEST(SizeChoice, ANumberIsUniform) {
  const ChosenSize chosen = choose(sizes("1.5"));
  EXPECT_EQ(chosen.uniform_mm, 1.5);
  EXPECT_TRUE(chosen.notes.empty());
}

TEST(SizeChoice, TheLeastOfInsideAndBoundaryCounts) {
  const ChosenSize chosen = choose(sizes("4", "1"));
  EXPECT_FALSE(chosen.uniform_mm);
  EXPECT_EQ(chosen.field->min_size(), 1);
  EXPECT_EQ(chosen.field->size_at({10, 0, 0}), 1);
  EXPECT_NEAR(chosen.field->size_at({7.5, 0, 0}), 3.5, 0.6);  // halfway between two surfaces, and no more than 4
  EXPECT_EQ(chosen.field->size_at({}), 4);
  EXPECT_TRUE(chosen.field->bounds_tets());
  EXPECT_GT(chosen.expected_vertices, 0.7 * 4 * 3.14 * (100 + 25));  // of squares of 1 mm on both surfaces, roughly
}

TEST(SizeChoice, PlacesHaveSizesOfTheirOwn) {
  SizeOptions options = sizes("3");
  options.size_where = {"ball(0, 0, 6, 1) = 0.5", "x > 4=6", "box(5, -1, -1, 7, 1, 1)=2"};
  const ChosenSize chosen = choose(options);
  EXPECT_FALSE(chosen.uniform_mm);
  EXPECT_NEAR(chosen.field->size_at({0, 0, 6}), 0.5, 0.3) << "a ball that a coarse grid would miss";
  EXPECT_NEAR(chosen.field->size_at({-6, 0, 0}), 3, 0.1) << "elsewhere";
  EXPECT_NEAR(chosen.field->size_at({6, 0, 0}), 2, 0.3) << "the smallest of two places";
  EXPECT_GT(chosen.field->size_at({8, 3, 3}), 3.5) << "a place may have a larger size than --size";
}

TEST(SizeChoice, PlacesThatNeedAMeshAndNoSizesAreRefused) {
  for (const char* text :
       {"patch(wall)=1", "x > 0 and region(2)=1", "x > 0", "x > 0=none", "x > 0=0", "=2", "x > =2"}) {
    SizeOptions options = sizes("3");
    options.size_where = {text};
    EXPECT_THROW(plan_sizes(options), Error) << text;
  }
}

TEST(SizeChoice, AutoAloneBoundsNoTets) {
  const ChosenSize chosen = choose(sizes("auto"));
  EXPECT_FALSE(chosen.field->bounds_tets());
  ASSERT_EQ(chosen.notes.size(), 1U);
  EXPECT_EQ(chosen.notes.front().find("auto: sizes from "), 0U);
}

TEST(SizeChoice, ARegionsSizeHoldsInIt) {
  const ChosenSize chosen = choose(sizes("3", "", {"2=1"}));
  EXPECT_NEAR(chosen.field->size_at({}), 1, 0.01);
  EXPECT_GT(chosen.field->size_at({0, 0, 9.5}), 2.5);
}

/// Sizes that vary, in a plate that hardly any point of its box is in.
TEST(AffordableSize, ThinObjectsAreNotTakenForLarge) {
  SizeLimits limits;
  limits.max_vertices = limits.usual_max_vertices = 20'000'000;
  limits.memory_bytes = 2e9;
  std::vector<SizeOptions> asked{sizes("1 + 0.001 * x"), sizes("2", "0.5"), sizes("2", "", {"1=1.5"}), sizes("2")};
  asked.back().layers = "2";
  for (const bool knows_volume : {true, false}) {
    OpenedDomain opened;
    opened.domain = std::make_unique<test::ThinPlate>(knows_volume);
    opened.default_size_mm = 0.4;
    for (const SizeOptions& options : asked) {
      Progress progress;
      const ChosenSize chosen = choose_affordable_size(options, plan_sizes(options), limits, opened, progress);
      EXPECT_FALSE(chosen.uniform_mm);
    }
    SizeLimits none = limits;
    none.memory_bytes = 1;
    try {
      Progress progress;
      choose_affordable_size(asked[0], plan_sizes(asked[0]), none, opened, progress);
      ADD_FAILURE() << "it was not refused";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), "usage.memory");
      EXPECT_EQ(std::string(error.what()).find("nan"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace scantet
