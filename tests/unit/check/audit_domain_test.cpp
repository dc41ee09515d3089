// Bent grids against analytic domains: good ones pass, and each fault is found and nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "boundary_flags.h"
#include "scantet/base/options.h"
#include "scantet/check/audit.h"
#include "scantet/domain/analytic.h"
#include "scantet/domain/curve.h"
#include "unit/check/audit_expectations.h"
#include "unit/nested_balls.h"
#include "unit/quality/grid_mesh.h"

namespace scantet {
namespace {

using test::anywhere;
using test::ball_mesh;
using test::bent;
using test::bent_grid;
using test::expect_only;
using test::kRadius;
using test::messages;

Region slab_left_out(int i, int, int) {
  return i == 3 ? kOutside : 1;
}
Region core_left_out(int i, int j, int k) {
  const auto middle = [](int x) { return x == 2 || x == 3; };
  return middle(i) && middle(j) && middle(k) ? kOutside : 1;
}

TEST(AuditDomain, BallPasses) {
  const auto sphere = make_sphere({1, 2, 3}, kRadius);
  const AuditReport report = audit(ball_mesh(6, {1, 2, 3}, kRadius), sphere.get(), bent());
  EXPECT_TRUE(report.passed()) << messages(report);
  ASSERT_TRUE(report.max_residual.has_value());
  EXPECT_LT(*report.max_residual, 1e-14);
  ASSERT_TRUE(report.ledger.has_value());
  EXPECT_EQ(report.ledger->expected_components, 1u);
  EXPECT_EQ(report.ledger->expected_cavities, 0u);
  EXPECT_TRUE(report.ledger->missing.empty());
  ASSERT_TRUE(report.circumcentres_astray.has_value());
}

TEST(AuditDomain, ShellPasses) {
  const auto shell = make_shell({}, 4, kRadius);
  const TetMesh mesh = bent_grid(
      6, {}, [](double depth) { return 1 + 3 * depth; }, core_left_out);
  const AuditReport report = audit(mesh, shell.get(), bent());
  EXPECT_TRUE(report.passed()) << messages(report);
  EXPECT_EQ(report.components.size(), 1u);
  EXPECT_EQ(report.boundary_components, 2u);
  EXPECT_EQ(report.cavities, 1u);
  EXPECT_EQ(report.boundary_euler, 4);
  ASSERT_TRUE(report.ledger.has_value());
  EXPECT_EQ(report.ledger->expected_cavities, 1u);
}

TEST(AuditDomain, VertexOffTheBoundary) {
  const auto sphere = make_sphere({}, kRadius);
  TetMesh mesh = ball_mesh(6, {}, kRadius);
  const VertexId moved = mesh.boundary_facets[5][1];
  mesh.vertices[moved] = 1.001 * mesh.vertices[moved];
  const AuditReport report = audit(mesh, sphere.get(), bent());
  expect_only(report, "audit.off_boundary", 1);
  EXPECT_EQ(report.findings[0].where, mesh.vertices[moved]);
  EXPECT_NEAR(*report.max_residual, 0.002, 1e-5);
}

TEST(AuditDomain, FlaggedVertexWithoutFacetIsAFault) {
  const auto sphere = make_sphere({}, kRadius);
  TetMesh mesh = ball_mesh(6, {}, kRadius);
  const std::vector<std::uint8_t> flags = test::boundary_flags(mesh);
  const auto inner = std::find(flags.begin(), flags.end(), 0);
  ASSERT_NE(inner, flags.end());
  mesh.strata[static_cast<std::size_t>(inner - flags.begin())].dimension = 2;
  expect_only(audit(mesh, sphere.get(), bent()), "audit.boundary_flag", 1);
}

TEST(AuditDomain, CircumcentreAstray) {
  const auto sphere = make_sphere({}, 1);
  TetMesh mesh;  // a low pyramid: its circumcentre is far below its base, outside of the sphere
  mesh.vertices = {{-0.9, 0, 0}, {0.45, -0.75, 0}, {0.45, 0.75, 0}, {0, 0, 0.1}};
  mesh.tets = {{0, 1, 2, 3}};
  mesh.tet_regions = {1};
  build_boundary(mesh);
  AuditOptions options;
  options.max_residual = 10;
  const AuditReport report = audit(mesh, sphere.get(), options);
  expect_only(report, "audit.circumcentre", 1);
  EXPECT_LT(report.findings[0].where.z, -1);
  options.restricted_delaunay = false;
  const AuditReport counted = audit(mesh, sphere.get(), options);
  EXPECT_TRUE(counted.passed());
  EXPECT_EQ(counted.circumcentres_astray, 1u);
}

// Four points at distance 1 from (0.1, 0.2, 0.3), up to rounding.
TEST(AuditDomain, CircumcentreOnTheBoundaryIsAMatterOfRounding) {
  TetMesh mesh;
  mesh.vertices = {{1.1, 0.2, 0.3}, {0.1, 1.2, 0.3}, {0.1, 0.2, 1.3}, {-0.9, 0.2, 0.3}};
  mesh.tets = {{0, 1, 2, 3}};
  mesh.tet_regions = {1};
  build_boundary(mesh);
  AuditOptions options;
  options.max_residual = 10;
  for (const double shift : {-1.0, 1.0}) {
    // The boundary passes through the circumcentre.
    const auto sphere = make_sphere({0.1, 0.2, 0.3 + 7 * shift}, 7);
    EXPECT_EQ(audit(mesh, sphere.get(), options).circumcentres_astray, 0u);
  }
}

TEST(AuditDomain, ComponentMissing) {
  const auto spheres = make_two_spheres(kRadius, 4);
  const AuditReport report = audit(ball_mesh(6, {-12, 0, 0}, kRadius), spheres.get(), bent());
  expect_only(report, "audit.component_missing", 1);
  ASSERT_TRUE(report.ledger.has_value());
  ASSERT_EQ(report.ledger->missing.size(), 1u);
  EXPECT_EQ(report.ledger->missing[0].witness, (Point{12, 0, 0}));
  EXPECT_EQ(report.ledger->missing[0].region, 1);
  EXPECT_EQ(report.ledger->expected_components, 2u);
}

TEST(AuditDomain, CavityMissing) {
  const auto shell = make_shell({}, 4, kRadius);
  const AuditReport report = audit(ball_mesh(6, {}, kRadius), shell.get(), bent());
  expect_only(report, "audit.cavity_missing", 1);
  ASSERT_TRUE(report.ledger.has_value());
  ASSERT_EQ(report.ledger->missing.size(), 1u);
  EXPECT_EQ(report.ledger->missing[0].region, kOutside);
}

TEST(AuditDomain, TooManyComponents) {
  const auto sphere = make_sphere({}, kRadius);
  // The smaller part comes first.
  const auto is_left_out = [](int i, int, int) { return i == 4 ? kOutside : Region{1}; };
  const AuditReport report = audit(ball_mesh(12, {}, kRadius, is_left_out), sphere.get(), anywhere());
  expect_only(report, "audit.component_count", 1);
  ASSERT_EQ(report.components.size(), 2U);
  ASSERT_LT(report.components[0].tets, report.components[1].tets);
  EXPECT_EQ(report.findings[0].places, std::vector<Point>{report.components[0].box_mm.center()});
}

TEST(AuditDomain, OneTooManyOfARegionDoesNotMakeUpForOneTooFewOfAnother) {
  const test::NestedBalls balls(0.4 * kRadius, kRadius);
  const AuditReport report = audit(ball_mesh(6, {}, kRadius, slab_left_out), &balls, anywhere());
  expect_only(report, "audit.component_count", 2);
  EXPECT_NE(report.findings[0].message.find("2 of region 1 in the mesh, 1 in the domain"), std::string::npos);
  EXPECT_NE(report.findings[0].message.find("0 of region 2 in the mesh, 1 in the domain"), std::string::npos);
}

TEST(AuditDomain, TooManyCavities) {
  const auto sphere = make_sphere({}, kRadius);
  const AuditReport report = audit(ball_mesh(6, {}, kRadius, core_left_out), sphere.get(), anywhere());
  expect_only(report, "audit.cavity_count", 1);
  ASSERT_EQ(report.findings[0].places.size(), 1U);
  EXPECT_LT(distance(report.findings[0].places[0], {}), 1e-6) << "in the middle of the one that is not the domain's";
}

// Two balls that grew together: both are there, but the count is wrong.
TEST(AuditDomain, ComponentsThatMerged) {
  const auto spheres = make_two_spheres(kRadius, 4);
  TetMesh mesh = ball_mesh(6, {}, kRadius);
  for (Point& p : mesh.vertices) p.x *= 2.2;
  const AuditReport report = audit(mesh, spheres.get(), anywhere());
  expect_only(report, "audit.component_count", 1);
  EXPECT_EQ(report.findings[0].places, std::vector<Point>{spheres->components()[1].witness}) << "the one in the other";
}

// Answers everything but which piece of boundary a point is on.
class Anonymous final : public Domain {
 public:
  explicit Anonymous(std::unique_ptr<Domain> domain) : domain_(std::move(domain)) {}
  Box bounds() const override { return domain_->bounds(); }
  Region region_at(const Point& p) const override { return domain_->region_at(p); }
  void crossings(const Segment& s, Crossings& out) const override { domain_->crossings(s, out); }
  std::vector<Component> components() const override { return domain_->components(); }

 private:
  std::unique_ptr<Domain> domain_;
};

TEST(AuditDomain, ComponentMissingInADomainThatCannotTellItsBoundaries) {
  const Anonymous spheres(make_two_spheres(kRadius, 4));
  const AuditReport report = audit(ball_mesh(6, {-12, 0, 0}, kRadius), &spheres, bent());
  expect_only(report, "audit.component_missing", 1);
  ASSERT_TRUE(report.ledger.has_value());
  EXPECT_FALSE(report.max_residual.has_value());
  EXPECT_EQ(report.ledger->missing[0].witness, (Point{12, 0, 0}));
}

AuditReport audit_of_distance(const TetMesh& mesh, const Domain& domain, const SizingField& size) {
  const BoundaryDistance distance = measure_distance(mesh, domain, {.limit_mm = {}, .size = &size});
  AuditOptions options = anywhere();
  options.distance = &distance;
  options.size = &size;
  return audit(mesh, &domain, options);
}

// Three quarters of a ball: what is left out has neither a component nor a handle of its own.
TEST(AuditDomain, PartThatTheMeshHasNot) {
  const auto sphere = make_sphere({}, kRadius);
  const TetMesh mesh = ball_mesh(6, {}, kRadius, [](int i, int j, int) { return i < 3 && j < 3 ? kOutside : 1; });
  const double far_mm = measure_distance(mesh, *sphere).to_mesh.lower_mm;
  ASSERT_GT(far_mm, 0.4 * kRadius);
  const AuditReport report = audit_of_distance(mesh, *sphere, UniformSize(0.499 * far_mm));
  expect_only(report, "audit.lost_part", report.findings.at(0).count);
  EXPECT_EQ(report.findings[0].where, measure_distance(mesh, *sphere).to_mesh.worst[0].point);
  EXPECT_NE(report.findings[0].message.find(number_text(far_mm, 3) + " mm"), std::string::npos);
  EXPECT_TRUE(audit_of_distance(mesh, *sphere, UniformSize(0.501 * far_mm)).findings.empty());
}

// The same on one side, where the size is large, and less on the other, where it is small.
TEST(AuditDomain, PartThatTheMeshHasNotWhereTheSizeIsSmall) {
  class TwoSizes final : public SizingField {
   public:
    double size_at(const Point& p) const override { return p.x < 0 ? kRadius : min_size(); }
    double min_size() const override { return 0.05 * kRadius; }
  };
  const auto sphere = make_sphere({}, kRadius);
  const TetMesh mesh =
      ball_mesh(6, {}, kRadius, [](int i, int j, int) { return (i < 3 && j < 3) || i == 5 ? kOutside : 1; });
  const BoundaryDistance distance = measure_distance(mesh, *sphere);
  ASSERT_LT(distance.to_mesh.worst.at(0).point.x, 0);
  const AuditReport report = audit_of_distance(mesh, *sphere, TwoSizes());
  expect_only(report, "audit.lost_part", report.findings.at(0).count);
  EXPECT_GT(report.findings[0].where.x, 0);
}

// A ball with a cavity that is a single point.
class WithPointCavity final : public Domain {
 public:
  Box bounds() const override { return domain_->bounds(); }
  Region region_at(const Point& p) const override { return p == kHole ? kOutside : domain_->region_at(p); }
  void crossings(const Segment& s, Crossings& out) const override {
    domain_->crossings(s, out);
    if (s.source == kHole) out.insert(out.begin(), {s.source, kOutside, 1});
  }
  std::vector<Component> components() const override {
    auto components = domain_->components();
    components.push_back({kOutside, kHole, {}, 0, false});
    return components;
  }

 private:
  static constexpr Point kHole{3, 1, 2};
  std::unique_ptr<Domain> domain_ = make_sphere({}, kRadius);
};

TEST(AuditDomain, CavityWithoutVolumeIsNotExpected) {
  const WithPointCavity domain;
  const AuditReport report = audit(ball_mesh(6, {}, kRadius), &domain, bent());
  EXPECT_TRUE(report.passed()) << messages(report);
  ASSERT_TRUE(report.ledger.has_value());
  EXPECT_EQ(report.ledger->expected_components, 1u);
  EXPECT_EQ(report.ledger->expected_cavities, 0u);
}

/// A ball that must show a curve.
class BallWithCurve final : public Domain {
 public:
  explicit BallWithCurve(std::vector<Point> points)
      : curve_(std::make_shared<PolylineCurve>(std::move(points), std::vector<Region>{0, 1},
                                               std::array<std::size_t, 2>{}, "rim")) {}
  Box bounds() const override { return ball_->bounds(); }
  Region region_at(const Point& p) const override { return ball_->region_at(p); }
  void crossings(const Segment& segment, Crossings& out) const override { ball_->crossings(segment, out); }
  std::vector<std::shared_ptr<const Curve>> curves() const override { return {curve_}; }

 private:
  std::unique_ptr<Domain> ball_ = make_sphere({}, kRadius);
  std::shared_ptr<const Curve> curve_;
};

/// Three vertices of the mesh's boundary in a row, the first and the last of which have no common edge.
std::vector<Point> points_in_a_row(const TetMesh& mesh) {
  std::set<std::pair<VertexId, VertexId>> edges;
  for (const Triangle& f : mesh.boundary_facets) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges.insert({f[k], f[(k + 1) % 3]});
      edges.insert({f[(k + 1) % 3], f[k]});
    }
  }
  for (const auto& [a, b] : edges) {
    for (const auto& [c, d] : edges) {
      if (c == b && d != a && edges.count({a, d}) == 0) return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[d]};
    }
  }
  return {};
}

TEST(AuditDomain, CurveThatTheMeshFollows) {
  const TetMesh mesh = ball_mesh(6, {}, kRadius);
  const AuditReport report = audit(mesh, std::make_unique<BallWithCurve>(points_in_a_row(mesh)).get(), bent());
  EXPECT_TRUE(report.passed());
}

TEST(AuditDomain, CurveThatTheMeshDoesNotFollowIsAFault) {
  const TetMesh mesh = ball_mesh(6, {}, kRadius);
  std::vector<Point> points = points_in_a_row(mesh);
  points.erase(points.begin() + 1);
  const BallWithCurve cut_short(points);
  expect_only(audit(mesh, &cut_short, bent()), "audit.curve", 1);
  const BallWithCurve elsewhere({{0, 0, 1.1 * kRadius}, {0, 0.1 * kRadius, 1.1 * kRadius}});
  expect_only(audit(mesh, &elsewhere, bent()), "audit.curve", 1);
}

}  // namespace
}  // namespace scantet
