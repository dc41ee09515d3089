#include <gtest/gtest.h>

#include <numbers>

#include "scantet/optimize/curve_guide_impl.h"
#include "scantet/optimize/smoothing_impl.h"
#include "unit/cut_balls.h"
#include "unit/optimize/operations.h"

namespace scantet::optimize {
namespace {

TEST(CurveGuide, FindsTheCurveOfAPointThatIsOnOneOnly) {
  const test::CutBall ball(10, 3);
  const CurveGuide guide(ball);
  for (const auto& curve : ball.curves()) {
    const double length_mm = curve->length_mm();
    for (const double share : {0.1, 0.37, 0.8}) {
      const Curve* const found = guide.curve_at(curve->at(share * length_mm));
      ASSERT_NE(found, nullptr);
      EXPECT_LT(found->nearest(curve->at(share * length_mm)).distance_mm, 1e-9);
      EXPECT_EQ(found->regions(), curve->regions());
    }
    if (curve->corners()) {
      EXPECT_EQ(guide.curve_at(curve->at(0)), nullptr);
      EXPECT_EQ(guide.curve_at(curve->at(length_mm)), nullptr);
    }
  }
  EXPECT_EQ(guide.curve_at({1, 2, 3}), nullptr);
  EXPECT_EQ(CurveGuide(*make_sphere({0, 0, 0}, 1)).curve_at({1, 0, 0}), nullptr);
}

TEST(CurveGuide, StepsEndAtCornersAndGoRoundWithoutThem) {
  const test::CutBall halves(10, 2);  // one closed curve
  const auto rim = halves.curves().front();
  ASSERT_FALSE(rim->corners());
  const double round_mm = rim->length_mm();
  EXPECT_NEAR(round_mm, 20 * std::numbers::pi, 1e-6);
  for (const double step_mm : {0.5, -0.5, 40.0, -40.0}) {
    const std::optional<Point> p = CurveGuide::step_along(*rim, rim->at(0.2), step_mm);
    ASSERT_TRUE(p);
    EXPECT_LT(distance(*p, rim->at(std::fmod(0.2 + step_mm + round_mm, round_mm))), 1e-6) << step_mm;
  }
  const test::CutBall wedges(10, 3);
  for (const auto& curve : wedges.curves()) {
    if (!curve->corners()) continue;
    const Point near_start = curve->at(0.01 * curve->length_mm());
    EXPECT_FALSE(CurveGuide::step_along(*curve, near_start, -0.02 * curve->length_mm()));
    EXPECT_FALSE(CurveGuide::step_along(*curve, near_start, curve->length_mm()));
    EXPECT_TRUE(CurveGuide::step_along(*curve, near_start, 0.5 * curve->length_mm()));
  }
}

TEST(CurveGuide, KeepsVerticesThatSmoothingMovesOnTheirCurve) {
  for (const int cells : {2, 3, 4}) {
    const test::CutBall ball(10, cells);
    const TetMesh mesh = refined(ball, 1.5);
    const TetComplex complex(mesh);
    SurfaceGuard guard(complex, ball, kTolerance);
    const CurveGuide curves(ball);
    Smoothing moving(complex, guard, Depth::usual, &curves);
    Smoothing holding(complex, guard);
    int moved = 0;
    for (VertexId v = 0; v < complex.vertex_slots(); ++v) {
      if (!complex.on_curve(v)) continue;
      Change best;
      best.reset(kInverted);
      holding.try_vertex(v, best);
      EXPECT_FALSE(best.found()) << "without the curves it stays";
      moving.try_vertex(v, best);
      EXPECT_FALSE(best.found() && mesh.strata[v].dimension == 0) << "a corner stays";
      if (!best.found() || best.position == complex.point(v)) continue;
      ++moved;
      const Curve* const curve = curves.curve_at(complex.point(v));
      ASSERT_NE(curve, nullptr);
      EXPECT_LT(curve->nearest(best.position).distance_mm, 1e-9);
      EXPECT_TRUE(best.on_boundary);
      if (moved % 5 != 0) continue;
      TetComplex changed(mesh);
      make_change(changed, best);
      const AuditReport report = audit_of(changed.release(), ball);
      EXPECT_TRUE(report.passed()) << report.findings.front().message;
    }
    EXPECT_GT(moved, 10) << cells;
  }
}

}  // namespace
}  // namespace scantet::optimize
