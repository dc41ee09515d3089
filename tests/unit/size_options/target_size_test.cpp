#include "scantet/size_options/target_size.h"

#include <gtest/gtest.h>

#include "error_code.h"
#include "scantet/base/error.h"
#include "scantet/domain/analytic.h"

namespace scantet {
namespace {

OpenedDomain ball() {
  OpenedDomain opened;
  opened.domain = make_sphere({}, 10);
  opened.default_size_mm = 1;
  return opened;
}

std::optional<TargetSize> target(const SizeOptions& sizes, const SizeLimits& limits = {}) {
  Progress progress;
  return choose_target_size(sizes, plan_sizes(sizes), limits, ball(), progress);
}

double tets_at(double size_mm) {
  Progress progress;
  return predict(find_features(*ball().domain, UniformSize(size_mm), 1, std::nullopt, progress).value()).tets;
}

TEST(TargetSize, NothingIsChosenUnasked) {
  EXPECT_FALSE(target({}));
  SizeLimits roomy;
  roomy.memory_bytes = 1e12;
  EXPECT_FALSE(target({}, roomy)) << "the input's own size fits";
}

TEST(TargetSize, SoManyTetsArePredictedForTheSizeChosen) {
  for (const double tets : {1e3, 2e4, 1e6}) {
    SizeOptions sizes;
    sizes.target_tets = tets;
    const auto chosen = target(sizes);
    ASSERT_TRUE(chosen);
    EXPECT_NEAR(tets_at(chosen->size_mm) / tets, 1, 0.1);
    EXPECT_NE(chosen->note.find("--target-tets"), std::string::npos);
    EXPECT_EQ(target(sizes)->size_mm, chosen->size_mm);
  }
}

TEST(TargetSize, OtherSizesOrTooFewTetsAreRefused) {
  const auto code = [](const SizeOptions& sizes) { return test::error_code([&] { target(sizes); }); };
  SizeOptions few;
  few.target_tets = 1;
  EXPECT_EQ(code(few), "usage.target_tets");
  SizeOptions both;
  both.target_tets = 1e5;
  both.size = "2";
  EXPECT_EQ(code(both), "usage.target_tets");
  both.size = "";
  both.boundary_size = "auto";
  EXPECT_EQ(code(both), "usage.target_tets");
  both.boundary_size = "";
  both.region_sizes = {"1=1"};
  EXPECT_EQ(code(both), "usage.target_tets");
  both.region_sizes = {};
  both.layers = "2";
  EXPECT_EQ(code(both), "usage.target_tets") << "they take tets that nobody has counted";
}

TEST(TargetSize, ASizeFitsIntoTheMemoryAllowedUnlessOneIsAskedFor) {
  const double own = predict({}).bytes;
  SizeLimits tight;
  tight.memory_bytes = 5e7 + 1.6 * own;
  OpenedDomain opened = ball();
  opened.default_size_mm = 0.05;
  Progress progress;
  const auto chosen = choose_target_size({}, plan_sizes({}), tight, opened, progress);
  ASSERT_TRUE(chosen);
  EXPECT_GT(chosen->size_mm, 0.05);
  EXPECT_NE(chosen->note.find("no --size given"), std::string::npos) << chosen->note;
  SizeOptions asked;
  asked.size = "0.05";
  EXPECT_FALSE(choose_target_size(asked, plan_sizes(asked), tight, opened, progress));
  tight.memory_bytes = 1e6;
  EXPECT_EQ(test::error_code([&] { choose_target_size({}, plan_sizes({}), tight, opened, progress); }), "usage.memory");
}

}  // namespace
}  // namespace scantet
