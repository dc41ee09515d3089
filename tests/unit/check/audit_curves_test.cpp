// Whether a mesh follows the curves of its domain, exactly or as one curve for several that are close to each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "scantet/check/audit.h"
#include "scantet/domain/analytic.h"
#include "scantet/domain/curve.h"
#include "scantet/domain/patch_pieces.h"
#include "scantet/refine/mesher.h"
#include "unit/cut_balls.h"

namespace scantet {
namespace {

constexpr double kRadiusMm = 10;
constexpr double kSizeMm = 2;

/// A ball cut into three wedges, and one more curve.
class WedgesWithCurve final : public Domain {
 public:
  WedgesWithCurve(std::vector<Point> points, std::vector<Region> regions)
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

using Curves = std::vector<std::shared_ptr<const Curve>>;

/// A curve that takes points of others near it to be on it, as those of label maps do.
class GreedyCurve final : public Curve {
 public:
  GreedyCurve(std::shared_ptr<const Curve> curve, Curves all, double reach_mm)
      : curve_(std::move(curve)), all_(std::move(all)), reach_mm_(reach_mm) {}
  double length_mm() const override { return curve_->length_mm(); }
  Point at(double along_mm) const override { return curve_->at(along_mm); }
  Nearest nearest(const Point& p) const override {
    const Nearest found = curve_->nearest(p);
    const auto holds = [&](const std::shared_ptr<const Curve>& curve) { return curve->nearest(p).distance_mm < 1e-9; };
    const bool takes = found.distance_mm < reach_mm_ && std::any_of(all_.begin(), all_.end(), holds);
    return takes ? Nearest{p, found.along_mm, 0} : found;
  }
  std::vector<Region> regions() const override { return curve_->regions(); }
  std::optional<std::array<std::size_t, 2>> corners() const override { return curve_->corners(); }

 private:
  std::shared_ptr<const Curve> curve_;
  Curves all_;
  double reach_mm_;
};

/// A ball cut into three wedges, with such curves.
class BallWithGreedyCurves final : public Domain {
 public:
  explicit BallWithGreedyCurves(double reach_mm) : reach_mm_(reach_mm) {}
  Box bounds() const override { return ball_.bounds(); }
  Region region_at(const Point& p) const override { return ball_.region_at(p); }
  void crossings(const Segment& segment, Crossings& out) const override { ball_.crossings(segment, out); }
  std::vector<std::shared_ptr<const Curve>> curves() const override {
    const Curves all = ball_.curves();
    Curves curves;
    for (const auto& curve : all) curves.push_back(std::make_shared<GreedyCurve>(curve, all, reach_mm_));
    return curves;
  }

 private:
  test::CutBall ball_{kRadiusMm, 3};
  double reach_mm_;
};

/// A ball whose surface has a piece of its own, the upper half, around which a curve goes; and one more curve.
class BallWithPiece final : public Domain, public PatchPieces {
 public:
  explicit BallWithPiece(std::shared_ptr<const Curve> curve) {
    curves_.push_back(std::make_shared<test::Arc>(kRadiusMm, Vec{1, 0, 0}, Vec{0, 1, 0}, 2 * M_PI,
                                                  std::vector<Region>{0, 1}, std::nullopt));
    if (curve != nullptr) curves_.push_back(std::move(curve));
  }
  Box bounds() const override { return ball_->bounds(); }
  Region region_at(const Point& p) const override { return ball_->region_at(p); }
  void crossings(const Segment& segment, Crossings& out) const override { ball_->crossings(segment, out); }
  Curves curves() const override { return curves_; }
  std::size_t piece_of(const std::array<Point, 3>& facet) const override {
    return facet[0].z + facet[1].z + facet[2].z > 0 ? 1 : 0;
  }
  std::string name_of_piece(std::size_t) const override { return "upper"; }

 private:
  std::unique_ptr<Domain> ball_ = make_sphere({}, kRadiusMm);
  Curves curves_;
};

class AuditCurves : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    Progress progress;
    ball_mesh = mesh_domain(test::CutBall(kRadiusMm, 3), UniformSize(kSizeMm), {}, progress).mesh;
  }

  /// How many gaps the audit finds in the curve; with sizes it knows how close another may stand for it.
  static std::uint64_t gaps(std::vector<Point> points, std::vector<Region> regions, bool with_sizes = true) {
    const WedgesWithCurve domain(std::move(points), std::move(regions));
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
  Progress progress_;
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

TEST_F(AuditCurves, EachOfFourRegionsMustBeAtEdgesAlongTheirCurve) {
  EXPECT_EQ(gaps(beside_axis(0.15 * kSizeMm), {1, 2, 3}), 0U);
  EXPECT_GT(gaps(beside_axis(0.15 * kSizeMm), {1, 2, 3, 4}), 0U);
}

TEST_F(AuditCurves, ARimStandsForOneBesideIt) {
  const UniformSize size(kSizeMm);
  AuditOptions options;
  options.restricted_delaunay = false;
  options.size = &size;
  const TetMesh mesh = mesh_domain(BallWithPiece(nullptr), size, {}, progress_).mesh;
  const auto gaps_beside_rim = [&](double beside_mm) {
    std::vector<Point> points;
    for (double angle = 0; angle < 2 * M_PI; angle += M_PI / 100) {
      points.push_back((kRadiusMm + beside_mm) * Vec{std::cos(angle), std::sin(angle), 0});
    }
    const BallWithPiece domain(
        std::make_shared<PolylineCurve>(points, std::vector<Region>{0, 1}, std::array<std::size_t, 2>{0, 1}, "extra"));
    return audit(mesh, &domain, options).findings.size();
  };
  EXPECT_EQ(gaps_beside_rim(0.15 * kSizeMm), 0U);
  EXPECT_EQ(gaps_beside_rim(0.3 * kSizeMm), 1U);
}

TEST_F(AuditCurves, WithoutSizesItMustBeTheCurveItself) {
  EXPECT_GT(gaps(beside_axis(0.15 * kSizeMm), {1, 2, 3}, false), 0U);
}

TEST_F(AuditCurves, VerticesOfOtherCurvesThatSeemToBeOnOneArePassedOver) {
  AuditOptions options;
  options.restricted_delaunay = false;
  const BallWithGreedyCurves domain(1.2 * kSizeMm);  // near the poles they take each other's first vertices
  EXPECT_TRUE(audit(ball_mesh, &domain, options).passed());
  const TetMesh other = mesh_domain(test::CutBall(kRadiusMm, 2), UniformSize(kSizeMm), {}, progress_).mesh;
  EXPECT_FALSE(audit(other, &domain, options).passed()) << "what is not there is still missed";
}

TEST_F(AuditCurves, AVertexStandsForACurveShorterThanThat) {
  const double mm = 0.1 * kSizeMm;
  EXPECT_EQ(gaps({{mm, 0, kRadiusMm}, {0, mm, kRadiusMm}}, {0, 2, 3}), 0U);
  EXPECT_GT(gaps({{0, 0, kRadiusMm}, {0, 0, kRadiusMm - 0.6 * kSizeMm}}, {0, 2, 3}), 0U);
}

}  // namespace
}  // namespace scantet
