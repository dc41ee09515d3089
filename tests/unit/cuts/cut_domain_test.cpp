#include "scantet/cuts/cut_domain.h"

#include <gtest/gtest.h>

#include <numbers>

#include "error_code.h"
#include "scantet/cuts/cut_text.h"
#include "scantet/domain/analytic.h"
#include "scantet/domain/known_components.h"
#include "scantet/domain/patch_pieces.h"
#include "unit/cut_balls.h"
#include "unit/sharp_cube.h"

namespace scantet {
namespace {

std::unique_ptr<Domain> cut(std::unique_ptr<Domain> domain, const std::vector<std::string>& cuts,
                            CutReport* report = nullptr, double step_mm = 0.5) {
  std::vector<CutPlane> planes;
  for (const std::string& text : cuts) read_cut("--cut", text, planes);
  return make_cut_domain(std::move(domain), planes, step_mm, step_mm, report);
}

double length_of(const Domain& domain) {
  double sum = 0;
  for (const auto& curve : domain.curves()) sum += curve->length_mm();
  return sum;
}

/// Points all along the curves are where the residual is none, and the nearest to themselves.
void expect_on_boundary(const Domain& domain, double residual) {
  for (const auto& curve : domain.curves()) {
    for (int n = 0; n <= 97; ++n) {
      const Point p = curve->at(curve->length_mm() * n / 97);
      EXPECT_LE(domain.residual_at(p).value_or(0), residual);
      EXPECT_LE(curve->nearest(p).distance_mm, 1e-9);
    }
  }
}

/// A circle that lines of the grid cross in a place or two: the rim bows far off the chords between these.
TEST(CutDomain, ARimSmallerThanASquareIsFollowedAllAround) {
  for (const double x : {0.0, 0.11, 0.23, 0.37}) {
    const auto domain = cut(make_sphere({x, 0.3 * x, 0}, 1), {"z < 0.95"});
    ASSERT_EQ(domain->curves().size(), 1U) << x;
    const Curve& rim = *domain->curves()[0];
    const double step_mm = rim.length_mm() / 100;
    EXPECT_NEAR(rim.length_mm(), 2 * std::numbers::pi * std::sqrt(1 - 0.95 * 0.95), 0.05) << x;
    for (int n = 0; n < 100; ++n) {
      EXPECT_LE(distance(rim.at(n * step_mm), rim.at((n + 1) * step_mm)), 1.5 * step_mm) << x << ": " << n;
    }
  }
}

TEST(CutDomain, ABallCutOffCentreHasACircleForARim) {
  CutReport report;
  const auto domain = cut(make_sphere({1, 2, 3}, 10), {"x < 7"}, &report);
  EXPECT_EQ(report.meets, std::vector<bool>{true});
  EXPECT_EQ(report.unsettled, 0U);
  ASSERT_EQ(domain->curves().size(), 1U);
  EXPECT_TRUE(domain->corners().empty());
  EXPECT_NEAR(length_of(*domain), 16 * std::numbers::pi, 0.01);
  for (int n = 0; n < 50; ++n) {
    const Point p = domain->curves()[0]->at(n);
    EXPECT_EQ(p.x, 7);
    EXPECT_NEAR(distance(p, {7, 2, 3}), 8, 1e-9);
  }
  expect_on_boundary(*domain, 1e-9);
  EXPECT_EQ(domain->curves()[0]->regions(), (std::vector<Region>{kOutside, 1}));
  EXPECT_EQ(domain->region_at({6.999, 2, 3}), 1);
  EXPECT_EQ(domain->region_at({7, 2, 3}), kOutside);
  EXPECT_LT(domain->bounds().max.x, 7.1);
  EXPECT_EQ(domain->name_of_patch(domain->patch_at({7, 3, 3})), "cut_1");
  EXPECT_EQ(domain->name_of_patch(domain->patch_at({-9, 2, 3})), "");
}

TEST(CutDomain, CrossingsOfATiltedPlaneAreOnIt) {
  const auto domain = cut(make_sphere({}, 10), {"x + 2y - 2z < 6"});
  ASSERT_EQ(domain->curves().size(), 1U);
  EXPECT_NEAR(length_of(*domain), 2 * std::numbers::pi * std::sqrt(96), 0.01);
  expect_on_boundary(*domain, 1e-9);
  Crossings crossings;
  domain->crossings({{-20, 0.1, 0.2}, {20, 0.1, 0.2}}, crossings);
  ASSERT_EQ(crossings.size(), 2U);
  const Point p = crossings[1].point;
  EXPECT_NEAR(p.x + 2 * p.y - 2 * p.z, 6, 1e-14);
  EXPECT_NE(crossings[0].patch(), crossings[1].patch());
  EXPECT_EQ(domain->patch_at(p), crossings[1].patch());
}

TEST(CutDomain, TwoPlanesThatMeetInsideHaveAnEdgeAndTwoArcs) {
  const auto domain = cut(make_sphere({}, 10), {"x < 6", "x + y < 6"});
  ASSERT_EQ(domain->curves().size(), 3U);
  ASSERT_EQ(domain->corners().size(), 2U);
  for (const Corner& corner : domain->corners()) {
    EXPECT_NEAR(std::abs(corner.point.z), 8, 1e-9);
    EXPECT_EQ(corner.regions, (std::vector<Region>{0, 1}));
  }
  EXPECT_NEAR(domain->curves()[0]->length_mm(), 16, 1e-9);
  for (const auto& curve : domain->curves()) ASSERT_TRUE(curve->corners());
  expect_on_boundary(*domain, 1e-9);
}

TEST(CutDomain, ABoxInABallHasItsEdges) {
  const auto domain = cut(make_sphere({}, 10), {"-3 < x < 3", "-2 < y < 2", "0 < x + z < 4"});
  EXPECT_EQ(domain->curves().size(), 12U);
  EXPECT_EQ(domain->corners().size(), 8U);
}

TEST(CutDomain, SharpEdgesEndAtThePlane) {
  const auto domain = cut(std::make_unique<test::SharpCube>(10), {"x + y + z < 3"});
  // Three of the cube's corners are left whole, one is off: six hits around.
  std::size_t at_plane = 0;
  for (const Corner& corner : domain->corners()) {
    at_plane += std::abs(corner.point.x + corner.point.y + corner.point.z - 3) < 1e-9 ? 1 : 0;
  }
  EXPECT_EQ(at_plane, 6U);
  EXPECT_EQ(domain->corners().size(), 6U + 4U);
  EXPECT_EQ(domain->curves().size(), 6U + 9U);
}

TEST(CutDomain, JunctionsMeetTheirRims) {
  CutReport report;
  const auto domain = cut(std::make_unique<test::CutBall>(10, 3), {"z + 0.1x < 4"}, &report);
  EXPECT_EQ(report.unsettled, 0U);
  // In the plane three lines meet and three arcs end: four corners there, and the pole.
  EXPECT_EQ(domain->corners().size(), 5U);
  EXPECT_EQ(domain->curves().size(), 4U + 6U);
  std::size_t of_three = 0;
  for (const auto& curve : domain->curves()) of_three += curve->regions().size() == 3 ? 1 : 0;
  EXPECT_EQ(of_three, 4U + 3U);
}

TEST(CutDomain, SmallPartsInThePlaneAreFound) {
  std::size_t found = 0;
  for (int n = 0; n < 40; ++n) {
    const double height = 10 - 0.5 * 0.3 * 0.3 / 10 - 1e-3;  // a circle wider than a square of the grid
    const auto domain =
        cut(make_sphere({0.013 * n, 0.029 * n, 0}, 10), {"z > " + std::to_string(height)}, nullptr, 0.5);
    found += domain->curves().size();
  }
  EXPECT_EQ(found, 40U);
}

TEST(CutDomain, ComponentsStayWhereNoPlaneMeetsThem) {
  EXPECT_EQ(cut(make_two_spheres(5, 2), {"z < 40"})->components().size(), 2U);
  const auto one = cut(make_two_spheres(5, 2), {"x < 0"})->components();
  ASSERT_EQ(one.size(), 1U);
  EXPECT_LT(one[0].witness.x, 0);
  CutReport report;
  const auto cut_one = cut(make_two_spheres(5, 2), {"x < 3"}, &report);
  EXPECT_TRUE(cut_one->components().empty()) << "not all are known";
  EXPECT_EQ(report.uncounted, 1U);
  EXPECT_EQ(report.counted, 1U);
  const std::vector<Component> known = known_components(*cut_one).components;
  ASSERT_EQ(known.size(), 1U);
  EXPECT_LT(known[0].witness.x, 0);
  cut(make_two_spheres(5, 2), {"x < 0"}, &report);
  EXPECT_EQ(report.uncounted, 0U);
}

TEST(CutDomain, SaysWhatThePlanesMiss) {
  CutReport report;
  cut(make_sphere({}, 10), {"x < 5", "y < 11"}, &report);
  EXPECT_EQ(report.meets, (std::vector<bool>{true, false}));
  for (const char* text : {"x > 11", "x > 1000", "z < -10.5"}) {
    EXPECT_EQ(test::error_code([&] { cut(make_sphere({}, 10), {text}); }), "input.cut") << text;
  }
  EXPECT_EQ(test::error_code([&] { cut(make_sphere({}, 10), {"x < -5", "x > 5"}); }), "input.cut");
}

}  // namespace
}  // namespace scantet
