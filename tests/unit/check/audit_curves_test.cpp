// Whether a mesh follows the curves of its domain, exactly or as one curve for several that are close to each other.
#include <gtest/gtest.h>

#include "scantet/check/audit.h"
#include "scantet/domain/curve.h"
#include "scantet/refine/mesher.h"
#include "unit/cut_balls.h"

namespace scantet {
namespace {

constexpr double kRadiusMm = 10;
constexpr double kSizeMm = 2;

/// A ball cut into three wedges, and one more curve.
class BallWithCurve final : public Domain {
 public:
  BallWithCurve(std::vector<Point> points, std::vector<Region> regions)
      : curve_(std::make_shared<PolylineCurve>(std::move(points), std::move(regions), std::array<std::size_t, 2>{0, 1},
                                               "extra")) {}
  Box bounds() const override { return ball_.bounds(); }
  Region region_at(const Point& p) const override { return ball_.region_at(p); }
  void crossings(const Segment& segment, Crossings& out) const override { ball_.crossings(segment, out); }
  std::vector<std::shared_ptr<const Curve>> curves() const override {
    std::vector<std::shared_ptr<const Curve>> curves = ball_.curves();
    curves.push_back(curve_);
    return curves;
  }

 private:
  test::CutBall ball_{kRadiusMm, 3};
  std::shared_ptr<const Curve> curve_;
};

class AuditCurves : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    Progress progress;
    ball_mesh = mesh_domain(test::CutBall(kRadiusMm, 3), UniformSize(kSizeMm), {}, progress).mesh;
  }

  /// How many gaps the audit finds in the curve; with sizes it knows how close another may stand for it.
  static std::uint64_t gaps(std::vector<Point> points, std::vector<Region> regions, bool with_sizes = true) {
    const BallWithCurve domain(std::move(points), std::move(regions));
    const UniformSize size(kSizeMm);
    AuditOptions options;
    options.restricted_delaunay = false;  // of weighted points: centres are those of orthogonal spheres
    options.size = with_sizes ? &size : nullptr;
    const AuditReport report = audit(ball_mesh, &domain, options);
    EXPECT_LE(report.findings.size(), 1U);
    if (report.passed()) return 0;
    EXPECT_EQ(report.findings[0].code, "audit.curve") << report.findings[0].message;
    return report.findings[0].count;
  }

  /// A line beside the axis, where regions 1, 2 and 3 meet.
  static std::vector<Point> beside_axis(double mm) { return {{mm, 0, -kRadiusMm}, {mm, 0, kRadiusMm}}; }

  static TetMesh ball_mesh;
};
TetMesh AuditCurves::ball_mesh;

TEST_F(AuditCurves, AnotherCurveStandsForOneBesideIt) {
  EXPECT_EQ(gaps(beside_axis(0.15 * kSizeMm), {1, 2, 3}), 0U);
}

TEST_F(AuditCurves, NoOtherStandsForOneThatIsFarther) {
  EXPECT_GT(gaps(beside_axis(0.3 * kSizeMm), {1, 2, 3}), 0U);
}

TEST_F(AuditCurves, NoOtherStandsForOneWithOtherRegions) {
  EXPECT_GT(gaps(beside_axis(0.15 * kSizeMm), {0, 1, 2}), 0U);
}

TEST_F(AuditCurves, WithoutSizesItMustBeTheCurveItself) {
  EXPECT_GT(gaps(beside_axis(0.15 * kSizeMm), {1, 2, 3}, false), 0U);
}

TEST_F(AuditCurves, AVertexStandsForACurveShorterThanThat) {
  const double mm = 0.1 * kSizeMm;
  EXPECT_EQ(gaps({{mm, 0, kRadiusMm}, {0, mm, kRadiusMm}}, {0, 2, 3}), 0U);
  EXPECT_GT(gaps({{0, 0, kRadiusMm}, {0, 0, kRadiusMm - 0.6 * kSizeMm}}, {0, 2, 3}), 0U);
}

}  // namespace
}  // namespace scantet
