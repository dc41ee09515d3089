#include <gtest/gtest.h>

#include "scantet/domain/analytic.h"
#include "scantet/optimize/facet_judge_impl.h"

namespace scantet::optimize {
namespace {

/// A facet of the regular tet inscribed in the unit sphere: circumradius √8/3, radius-edge ratio 1/√3; its surface ball
/// is 2/3 away and has radius √(4/3).
class InscribedFacet : public testing::Test {
 protected:
  FacetShares shares(double size_mm, const RuleBounds& bounds, const Corners& corners) const {
    const UniformSize size(size_mm);
    Crossings crossings;
    return FacetJudge(*sphere_, {bounds, &size}).shares(corners, crossings);
  }

  static constexpr double kS = 0.57735026918962576;
  std::unique_ptr<Domain> sphere_ = make_sphere({0, 0, 0}, 1);
  Corners facet_{Point{kS, kS, kS}, {-kS, kS, -kS}, {kS, -kS, -kS}};
};

TEST_F(InscribedFacet, HasItsShareOfEachBound) {
  const RuleBounds bounds{0.8, 1.2, 2, 0.5, 1};
  const FacetShares s = shares(1.5, bounds, facet_);
  EXPECT_NEAR(s.radius_edge, 1.2 * 1.2 * 3, 1e-6);
  EXPECT_NEAR(s.size, 1.2 * 1.2 / (4.0 / 3), 1e-6);
  EXPECT_NEAR(s.distance, 0.5 * 0.5 / (4.0 / 9), 1e-6);
  EXPECT_EQ(s.least(), s.distance);
}

TEST_F(InscribedFacet, MayHaveALargerRatioIfItIsSmall) {
  RuleBounds bounds;
  bounds.small_slack = 1.5;
  const double radius = std::sqrt(8.0) / 3;
  EXPECT_NEAR(shares(1.99 * radius, bounds, facet_).radius_edge, 3, 1e-6);
  EXPECT_NEAR(shares(2.01 * radius, bounds, facet_).radius_edge, 3 * 1.5 * 1.5, 1e-6);
}

TEST_F(InscribedFacet, IsTheSameFromAllSides) {
  const FacetShares s = shares(1.2, {}, facet_);
  for (const Corners& other : {Corners{facet_[1], facet_[2], facet_[0]}, Corners{facet_[1], facet_[0], facet_[2]}}) {
    const FacetShares t = shares(1.2, {}, other);
    EXPECT_NEAR(t.radius_edge, s.radius_edge, 1e-9);
    EXPECT_NEAR(t.size, s.size, 1e-9);
  }
}

TEST_F(InscribedFacet, WithoutABallInReachHasNoSize) {
  const FacetShares s = shares(0.6, {}, facet_);
  EXPECT_EQ(s.size, 0);
  EXPECT_GT(s.radius_edge, 1);
}

TEST_F(InscribedFacet, IsNotHeldToADistanceThatIsNotAskedFor) {
  EXPECT_GT(shares(1.2, {}, facet_).distance, 1e300);
}

TEST_F(InscribedFacet, HasNothingWhereItIsFlatToALine) {
  const FacetShares s = shares(1.2, {}, {facet_[0], facet_[1], lerp(facet_[0], facet_[1], 0.5)});
  EXPECT_EQ(s.least(), 0);
  EXPECT_EQ(shares(1.2, {}, {facet_[0], facet_[0], facet_[0]}).least(), 0);
}

}  // namespace
}  // namespace scantet::optimize
