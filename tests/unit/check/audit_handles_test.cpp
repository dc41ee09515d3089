// Bent grids against analytic domains: components that are joined, and handles.
#include <gtest/gtest.h>

#include <algorithm>

#include "boundary_flags.h"
#include "scantet/check/audit.h"
#include "scantet/domain/analytic.h"
#include "scantet/domain/known_components.h"
#include "unit/check/audit_expectations.h"
#include "unit/nested_balls.h"

namespace scantet {
namespace {

using test::anywhere;
using test::ball_mesh;
using test::expect_only;
using test::kRadius;
using test::messages;

/// The mesh with another beside it.
TetMesh joined(TetMesh mesh, const TetMesh& part) {
  const auto first = static_cast<VertexId>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (Tet tet : part.tets) {
    for (VertexId& v : tet) v += first;
    mesh.tets.push_back(tet);
    mesh.tet_regions.push_back(1);
  }
  build_boundary(mesh);
  return mesh;
}

// As many components as there should be, but one is of both balls, and one is a part of them.
TEST(AuditHandles, AJoinDoesNotMakeUpForASplit) {
  const auto spheres = make_two_spheres(kRadius, 4);
  TetMesh mesh = ball_mesh(6, {}, kRadius);
  for (Point& p : mesh.vertices) p.x *= 2.2;
  mesh = joined(mesh, ball_mesh(2, {12, 30, 0}, 1));
  AuditOptions far_off = anywhere();
  far_off.max_residual = 1000;
  const AuditReport report = audit(mesh, spheres.get(), far_off);
  EXPECT_EQ(report.components.size(), 2u);
  expect_only(report, "audit.component_joined", 2);
}

/// Two balls, of which only the one on the left is known to be there, and to be whole.
class KnowsOneBall final : public Domain, public KnownComponents {
 public:
  Box bounds() const override { return balls_->bounds(); }
  Region region_at(const Point& p) const override { return balls_->region_at(p); }
  void crossings(const Segment& s, Crossings& out) const override { balls_->crossings(s, out); }
  Patch patch_at(const Point& p) const override { return balls_->patch_at(p); }
  std::vector<Component> known_components() const override {
    std::vector<Component> all = balls_->components();
    std::erase_if(all, [](const Component& component) { return component.witness.x > 0; });
    return all;
  }

 private:
  std::unique_ptr<Domain> balls_ = make_two_spheres(kRadius, 4);
};

TEST(AuditHandles, ComponentsThatAreKnownAreComparedBesideOthers) {
  const KnowsOneBall domain;
  const TetMesh right = ball_mesh(6, {kRadius + 2, 0, 0}, kRadius);
  const TetMesh left = ball_mesh(6, {-kRadius - 2, 0, 0}, kRadius);
  const AuditReport passed = audit(joined(right, left), &domain, anywhere());
  EXPECT_TRUE(passed.passed()) << messages(passed);
  expect_only(audit(right, &domain, anywhere()), "audit.component_missing", 1);
  const TetMesh parted = joined(joined(right, left), ball_mesh(2, {-kRadius - 2, 3 * kRadius, 0}, 1));
  expect_only(audit(parted, &domain, anywhere()), "audit.component_split", 1);
  const auto bored = [](int, int j, int k) { return (j == 2 || j == 3) && (k == 2 || k == 3) ? kOutside : 1; };
  const TetMesh through = joined(right, ball_mesh(6, {-kRadius - 2, 0, 0}, kRadius, bored));
  const AuditReport report = audit(through, &domain, anywhere());
  expect_only(report, "audit.handles", 1);
  EXPECT_FALSE(report.ledger.has_value()) << "not all are known";
  EXPECT_FALSE(report.handle_ledger->domain_euler.has_value());
}

// A ball whose middle row is left out is bored through.
TEST(AuditHandles, HandleThatTheDomainHasNot) {
  const auto bored = [](int, int j, int k) { return (j == 2 || j == 3) && (k == 2 || k == 3) ? kOutside : 1; };
  const auto sphere = make_sphere({}, kRadius);
  const AuditReport report = audit(ball_mesh(6, {}, kRadius, bored), sphere.get(), anywhere());
  expect_only(report, "audit.handles", 1);
  EXPECT_NE(report.findings[0].message.find("1 in the mesh, 0 in the domain"), std::string::npos);
  ASSERT_TRUE(report.handle_ledger.has_value());
  const HandleLedger& ledger = *report.handle_ledger;
  EXPECT_EQ(ledger.compared, 1u);
  EXPECT_EQ(ledger.unknown, 0u);
  EXPECT_EQ(ledger.expected_handles, 0);
  EXPECT_EQ(ledger.handles, 1);
  EXPECT_EQ(ledger.expected_euler, 2);
  EXPECT_EQ(ledger.euler, 0);
  ASSERT_EQ(ledger.different.size(), 1u);
  EXPECT_EQ(ledger.different[0].handles(), 1);
  EXPECT_EQ(report.findings[0].where, ledger.different[0].component.witness);
}

// A shell whose cavity is a ring, by what it says of its components.
class WithRingCavity final : public Domain {
 public:
  Box bounds() const override { return shell_->bounds(); }
  Region region_at(const Point& p) const override { return shell_->region_at(p); }
  void crossings(const Segment& s, Crossings& out) const override {
    shell_->crossings(s, out);
    for (Crossing& c : out) c.components = patch_at(c.point).components;
  }
  Patch patch_at(const Point& p) const override { return {{kOutside, 1}, {length(p) < 0.45 * kRadius ? 1U : 0U, 0U}}; }
  std::vector<Component> components() const override {
    Component shell{1, {0, 0, 0.9 * kRadius}, shell_->bounds()};
    shell.euler = 2;
    shell.surfaces = 2;
    Component ring{kOutside, {}, shell_->bounds()};
    ring.euler = 0;
    ring.surfaces = 1;
    return {shell, ring};
  }

 private:
  std::unique_ptr<Domain> shell_ = make_shell({}, 0.4 * kRadius, kRadius);
};

// A bore beside the cavity makes up for its handle in the component's sum.
TEST(AuditHandles, HandleOfAnotherSurface) {
  const auto bored_beside = [](int i, int j, int k) {
    const bool is_cavity = (i == 3 || i == 4) && (j == 3 || j == 4) && (k == 3 || k == 4);
    return is_cavity || (j == 1 && k == 1) ? kOutside : 1;
  };
  const WithRingCavity domain;
  const AuditReport report = audit(ball_mesh(8, {}, kRadius, bored_beside), &domain, anywhere());
  expect_only(report, "audit.handles", 1);
  EXPECT_NE(report.findings[0].message.find("the cavity with 0 in the mesh, 1 in the domain"), std::string::npos);
  EXPECT_EQ(report.handle_ledger->handles, report.handle_ledger->expected_handles);
  EXPECT_EQ(report.handle_ledger->compared_cavities, 1u);
}

TEST(AuditHandles, HandleThatTheMeshHasNot) {
  const auto torus = make_torus({}, kRadius, 0.4 * kRadius);
  const AuditReport report = audit(ball_mesh(6, {}, kRadius), torus.get(), anywhere());
  ASSERT_TRUE(report.handle_ledger.has_value());
  EXPECT_EQ(report.handle_ledger->expected_handles, 1);
  EXPECT_EQ(report.handle_ledger->handles, 0);
  EXPECT_TRUE(std::any_of(report.findings.begin(), report.findings.end(),
                          [](const Finding& finding) { return finding.code == "audit.handles"; }));
}

TEST(AuditHandles, HandlesThatTheDomainDoesNotKnowAreNotCompared) {
  const test::NestedBalls balls(0.4 * kRadius, kRadius);
  EXPECT_FALSE(audit(ball_mesh(6, {}, kRadius), &balls, anywhere()).handle_ledger.has_value());
}

}  // namespace
}  // namespace scantet
