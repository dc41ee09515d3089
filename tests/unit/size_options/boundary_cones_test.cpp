#include "scantet/size_options/boundary_cones.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cancelled_after.h"
#include "scantet/base/error.h"
#include "scantet/domain/analytic.h"

namespace scantet {
namespace {

constexpr double kRadius = 10;

OpenedDomain opened_ball() {
  OpenedDomain opened;
  opened.domain = make_sphere({}, kRadius);
  return opened;
}

BoundaryCones asked(const std::string& text, double least_mm = 0) {
  const auto ball = make_sphere({}, kRadius);
  const SizeRequest request = read_size("--boundary-size", text);
  Progress progress;
  if (request.source) return asked_cones(*ball, request, *request.source, least_mm, progress);
  return asked_cones(*ball, request, UniformSource(request.size_mm), least_mm, progress);
}

TEST(AutoSizes, FollowFromTheInputWhereTheOptionsDoNotSay) {
  OpenedDomain opened = opened_ball();
  EXPECT_DOUBLE_EQ(auto_sizes({}, opened).least_mm, opened.domain->bounds().extent().x / 200);
  EXPECT_EQ(auto_sizes({}, opened).share, kFeatureShare);
  opened.frame = Frame({Vec{0.5, 0, 0}, Vec{0, 0.7, 0}, Vec{0, 0, 2}}, {});
  EXPECT_DOUBLE_EQ(auto_sizes({}, opened).least_mm, 0.5);
  opened.min_size_mm = 0.8;
  EXPECT_DOUBLE_EQ(auto_sizes({}, opened).least_mm, 0.8);
}

TEST(AutoSizes, ObeyTheOptions) {
  SizeOptions options;
  options.least_mm = 0.25;
  options.feature_share = 0.1;
  options.lipschitz_k = 0.2;
  const AutoSizes how = auto_sizes(options, opened_ball());
  EXPECT_EQ(how.least_mm, 0.25);
  EXPECT_EQ(how.share, 0.1);
  EXPECT_EQ(how.features.lipschitz_k, 0.2);
  EXPECT_DOUBLE_EQ(how.features.spacing_mm, 0.25 / 0.1 / 4);  // four points along the least feature
}

TEST(AutoCones, ACoarseLookTellsAboutHowManyVerticesTheyMean) {
  SizeOptions options;
  options.least_mm = 0.5;
  options.feature_share = 0.2;
  const OpenedDomain opened = opened_ball();
  const AutoSizes how = auto_sizes(options, opened);
  Progress progress;
  const double close = vertices_of(auto_cones(*opened.domain, how, progress), *opened.domain);
  const double rough = rough_vertices(*opened.domain, how, progress);
  EXPECT_NEAR(rough, close, 0.3 * close);
  EXPECT_GT(rough, 0.5 * 3.14 * kRadius * kRadius) << "about one for each square of 2 mm";
  test::CancelledAfter cancelled(0);
  EXPECT_EQ(rough_vertices(*opened.domain, how, cancelled), 0);
}

TEST(AutoCones, AreAShareOfTheDistanceToTheMedialAxis) {
  SizeOptions options;
  options.least_mm = 0.5;
  options.feature_share = 0.2;
  const OpenedDomain opened = opened_ball();
  Progress progress;
  const BoundaryCones cones = auto_cones(*opened.domain, auto_sizes(options, opened), progress);
  ASSERT_FALSE(cones.sizes.empty());
  for (const Cone& cone : cones.sizes) EXPECT_NEAR(cone.height_mm, 0.2 * kRadius, 0.2);
  options.least_mm = 3;
  for (const Cone& cone : auto_cones(*opened.domain, auto_sizes(options, opened), progress).sizes) {
    EXPECT_EQ(cone.height_mm, 3);
  }
}

TEST(AutoCones, AreEmptyIfCancelled) {
  test::CancelledAfter progress(0);
  const OpenedDomain opened = opened_ball();
  EXPECT_TRUE(auto_cones(*opened.domain, auto_sizes({}, opened), progress).sizes.empty());
}

TEST(AskedCones, ANumberIsSampledAtHalfOfItself) {
  const BoundaryCones cones = asked("2", 5);
  EXPECT_EQ(cones.spacing_mm, 1);
  ASSERT_GT(cones.sizes.size(), 4 * 3.14 * kRadius * kRadius / 4);
  for (const Cone& cone : cones.sizes) {
    EXPECT_EQ(cone.height_mm, 2);  // a number is meant: the least size is of formulas and images
    EXPECT_NEAR(length(cone.apex), kRadius, 1e-6);
  }
}

TEST(AskedCones, AFormulaIsRaisedToTheLeastSizeAndNoLargerThanTheObject) {
  for (const Cone& cone : asked("1 + 1000 * (x > 0)", 2).sizes) {
    EXPECT_DOUBLE_EQ(cone.height_mm, cone.apex.x > 0 ? make_sphere({}, kRadius)->bounds().diagonal() : 2);
  }
}

TEST(AskedCones, RefuseWhatIsNoSize) {
  try {
    asked("5 - x");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), "usage.size");
    EXPECT_NE(std::string(error.what()).find("--boundary-size: \"5 - x\" gives "), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("region 1"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace scantet
