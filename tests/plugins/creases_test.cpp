// The edges that min, max and abs make in formulas.
#include <gtest/gtest.h>

#include <cmath>

#include "contract/plugin_case.h"
#include "error_code.h"
#include "scantet/check/audit.h"
#include "scantet/optimize/optimizer.h"
#include "scantet/quality/quality.h"
#include "scantet/refine/mesher.h"

namespace scantet {
namespace {

constexpr const char* kCube = "max(abs(x), max(abs(y), abs(z))) - 1";
constexpr const char* kCutCylinder = "max(max(x^2 + y^2 - 1, z + 0.2*x - 1), -z - 1)";
constexpr const char* kTwoBalls = "min((x + 0.5)^2 + y^2 + z^2 - 1, (x - 0.5)^2 + y^2 + z^2 - 1)";
constexpr const char* kLens = "max((x + 0.5)^2 + y^2 + z^2 - 1, (x - 0.5)^2 + y^2 + z^2 - 1)";

std::unique_ptr<Domain> open_creased(const std::string& formula, const std::string& degrees = "20") {
  return open_with_plugin(SCANTET_IMPLICIT_PLUGIN, "implicit:" + formula,
                          {{"bounds", "-2.1,-2.1,-2.1,2.1,2.1,2.1"}, {"sharp-edges", degrees}});
}

double total_length(const Domain& domain) {
  double length = 0;
  for (const auto& curve : domain.curves()) length += curve->length_mm();
  return length;
}

TEST(Creases, ACubeHasTwelveEdgesAndEightCorners) {
  const auto cube = open_creased(kCube);
  ASSERT_EQ(cube->curves().size(), 12U);
  ASSERT_EQ(cube->corners().size(), 8U);
  for (const Corner& corner : cube->corners()) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(std::abs(corner.point[axis]), 1, 1e-14);
  }
  EXPECT_NEAR(total_length(*cube), 24, 1e-12);
  for (const auto& curve : cube->curves()) {
    const Point p = curve->at(0.37 * curve->length_mm());
    EXPECT_EQ((std::abs(std::abs(p.x) - 1) < 1e-14) + (std::abs(std::abs(p.y) - 1) < 1e-14) +
                  (std::abs(std::abs(p.z) - 1) < 1e-14),
              2);
    EXPECT_EQ(curve->regions(), (std::vector<Region>{1, kOutside}));
  }
  EXPECT_TRUE(open_creased(kCube, "91")->curves().empty());
  EXPECT_TRUE(open_creased("x^2 + y^2 + z^2 - 1")->curves().empty());
  EXPECT_EQ(open_creased("abs(x) + abs(y) + abs(z) - 1")->curves().size(), 12U) << "an octahedron";
}

TEST(Creases, FormulasWithTooManyPartsAreRefused) {
  std::string formula = "max(x,-x,y,-y,z";
  for (int n = 0; n < 30'000; ++n) formula += ",-z";
  EXPECT_EQ(test::error_code([&] { open_creased(formula + ") - 1"); }), "input.formula");
}

TEST(Creases, RimsAreRoundAndClosed) {
  const auto cylinder = open_creased(kCutCylinder);
  ASSERT_EQ(cylinder->curves().size(), 2U);
  EXPECT_TRUE(cylinder->corners().empty());
  for (const auto& curve : cylinder->curves()) {
    for (int n = 0; n < 50; ++n) {
      const Point p = curve->at(n * curve->length_mm() / 50);
      EXPECT_NEAR(p.x * p.x + p.y * p.y, 1, 1e-13);
      EXPECT_LE(std::min(std::abs(p.z + 1), std::abs(p.z + 0.2 * p.x - 1)), 1e-13);
    }
  }
  for (const char* formula : {kTwoBalls, kLens}) {
    const auto balls = open_creased(formula);
    ASSERT_EQ(balls->curves().size(), 1U) << formula;
    EXPECT_NEAR(total_length(*balls), 2 * M_PI * std::sqrt(0.75), 1e-2);
    const Curve::Nearest nearest = balls->curves()[0]->nearest({0.01, 0.9, 0.02});
    EXPECT_NEAR(nearest.point.x, 0, 1e-14);
    EXPECT_NEAR(std::hypot(nearest.point.y, nearest.point.z), std::sqrt(0.75), 1e-14);
  }
}

TEST(Creases, WhatEndsAtAThirdSurfaceHasCornersThere) {
  // A quarter of a ball's surface is left: two planes and the ball.
  const auto wedge = open_creased("max(x^2 + y^2 + z^2 - 1, max(x - 0.1, y - 0.2))");
  EXPECT_EQ(wedge->corners().size(), 2U);
  EXPECT_EQ(wedge->curves().size(), 3U);
  for (const Corner& corner : wedge->corners()) {
    EXPECT_NEAR(corner.point.x, 0.1, 1e-14);
    EXPECT_NEAR(corner.point.y, 0.2, 1e-14);
    EXPECT_NEAR(squared_length(corner.point), 1, 1e-14);
  }
}

TEST(Creases, MeshesFollowThemAndKeepTenDegrees) {
  for (const char* formula : {kCube, kCutCylinder, kTwoBalls}) {
    const auto domain = open_creased(formula);
    Progress progress;
    const UniformSize size(0.35);
    MeshResult result = mesh_domain(*domain, size, {}, progress);
    ASSERT_EQ(result.stop, Stop::converged);
    optimize_mesh(result.mesh, *domain, {}, progress);
    const TetMesh& mesh = result.mesh;
    double along = 0;
    for (const auto& edge : mesh.curve_edges) {
      const Point& p = mesh.vertices[edge[0]];
      along += distance(p, mesh.vertices[edge[1]]);
      double beside = 1;
      for (const auto& curve : domain->curves()) beside = std::min(beside, curve->nearest(p).distance_mm);
      EXPECT_LE(beside, 1e-12) << formula;
    }
    EXPECT_NEAR(along, total_length(*domain), 0.03 * along) << formula;
    EXPECT_GE(measure_quality(mesh).min_dihedral_deg(), 10) << formula;
    AuditOptions options;
    options.restricted_delaunay = false;  // regions are those of orthocentres, which a mesh does not know
    const AuditReport report = audit(mesh, domain.get(), options);
    for (const Finding& finding : report.findings) {
      ADD_FAILURE() << formula << ": " << finding.message;
    }
  }
}

TEST(Creases, TooManyPartsAreRefused) {
  std::string many = "x^2 + y^2 + z^2 - 1";
  for (int n = 0; n < 40; ++n) many = "min(" + many + ", (x - 0.0" + std::to_string(n) + ")^2 + y^2 + z^2 - 1)";
  EXPECT_EQ(test::error_code([&] { open_creased(many); }), "input.formula");
}

}  // namespace
}  // namespace scantet
