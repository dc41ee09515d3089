// What sampling at the size asked for misses: found again by a search for it, or by meshing finer there.
#include "scantet/app/meshing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "scantet/check/audit.h"
#include "scantet/image/level_set.h"
#include "unit/image/test_scan.h"

namespace scantet {
namespace {

/// A ball of radius 14 mm around a void, from which a channel of voxels of that value leads out, in steps, so that no
/// place in it is a saddle; the level is 50.
std::unique_ptr<Domain> ball_with_channel(double value, double void_mm = 6) {
  const Scan scan = test::scan_of_function<float>({36, 36, 36}, [&](int i, int j, int k) {
    const double r = std::hypot(i - 17.5, j - 17.5, k - 17.5);
    const double shell = std::clamp(50 + 20 * std::min(14 - r, r - void_mm), 0.0, 100.0);
    const bool in_channel = k == 17 && i >= 20 && (j == i - 3 || j == i - 4);
    return in_channel ? std::min(shell, value) : shell;
  });
  LevelSetSettings settings;
  settings.level = 50;
  return make_level_set(scan, settings);
}

Meshing meshing_of(const Domain& domain, double size_mm, std::uint64_t threads = 0) {
  MesherOptions options;
  options.threads = threads;
  Progress progress;
  return *mesh_and_optimize(domain, std::make_shared<UniformSize>(size_mm), options, {}, progress);
}

AuditReport audit_of(const Meshing& meshing, const Domain& domain) {
  AuditOptions options;
  options.restricted_delaunay = false;
  return audit(meshing.refined.mesh, &domain, options);
}

TEST(Meshing, OpensAChannelMuchThinnerThanTheSize) {
  for (const double value : {30.0, 40.0}) {  // about 0.6 and 0.3 mm wide
    const auto domain = ball_with_channel(value);
    ASSERT_EQ(domain->components().size(), 1U) << "the void is no cavity";
    for (const double size_mm : {2.0, 3.0, 5.0}) {
      const Meshing meshing = meshing_of(*domain, size_mm);
      const AuditReport report = audit_of(meshing, *domain);
      EXPECT_TRUE(report.passed()) << size_mm << " mm: " << report.findings.front().message;
      EXPECT_EQ(report.boundary_components, 1U);
      EXPECT_TRUE(meshing.refined.tangled.empty());
      EXPECT_EQ(meshing.refined.counts.unmet.total(), 0U);
      EXPECT_TRUE(meshing.conformance.holds());
    }
  }
}

TEST(Meshing, AChannelWithoutWidthIsNone) {
  const auto domain = ball_with_channel(50);  // all along at the level itself
  ASSERT_EQ(domain->components().size(), 2U) << "the void is a cavity";
  for (const double size_mm : {2.0, 4.0}) {
    const AuditReport report = audit_of(meshing_of(*domain, size_mm), *domain);
    EXPECT_TRUE(report.passed()) << size_mm << " mm: " << report.findings.front().message;
    EXPECT_EQ(report.cavities, 1U);
  }
}

/// A ball around a void; a straight channel of one line of voxels leads out, and at one of them is a neck of 0.05 mm.
std::unique_ptr<Domain> ball_with_neck() {
  const Scan scan = test::scan_of_function<float>({36, 36, 36}, [&](int i, int j, int k) {
    const double r = std::hypot(i - 17.5, j - 17.5, k - 17.5);
    const double shell = std::clamp(50 + 20 * std::min(14 - r, r - 6), 0.0, 100.0);
    const bool in_channel = k == 17 && j == 17 && i >= 20;
    return in_channel ? std::min(shell, i == 27 ? 49.0 : 20.0) : shell;
  });
  LevelSetSettings settings;
  settings.level = 50;
  return make_level_set(scan, settings);
}

TEST(Meshing, OpensANeckMuchThinnerThanTheStepsOfTheSearch) {
  const auto domain = ball_with_neck();
  ASSERT_EQ(domain->components().size(), 1U) << "the void is no cavity";
  for (const double size_mm : {3.0, 5.0}) {
    const Meshing meshing = meshing_of(*domain, size_mm);
    const AuditReport report = audit_of(meshing, *domain);
    EXPECT_TRUE(report.passed()) << size_mm << " mm: " << report.findings.front().message;
    EXPECT_TRUE(meshing.refined.tangled.empty());
  }
}

TEST(Meshing, AChannelTooThinToOpenIsToldOf) {
  const auto domain = ball_with_channel(49.99, 5);
  const Meshing meshing = meshing_of(*domain, 5);
  ASSERT_EQ(meshing.refined.tangled.size(), 1U);
  EXPECT_LT(*domain->residual_at(meshing.refined.tangled.front()), 1e-6);
  EXPECT_LT(distance(meshing.refined.tangled.front(), {17.5, 17.5, 17.5}), 10) << "on the void's wall";
  const AuditReport report = audit_of(meshing, *domain);
  ASSERT_EQ(report.findings.size(), 1U);
  EXPECT_EQ(report.findings.front().code, "audit.cavity_count");
}

TEST(Meshing, OpeningAChannelDoesNotDependOnTheThreads) {
  const auto domain = ball_with_channel(40);
  const Meshing one = meshing_of(*domain, 4, 1);
  const Meshing three = meshing_of(*domain, 4, 3);
  EXPECT_EQ(one.refined.mesh.vertices, three.refined.mesh.vertices);
  EXPECT_EQ(one.refined.mesh.tets, three.refined.mesh.tets);
}

TEST(Meshing, WhereTetsStaySharpTheSizeIsFinerAndTheRestStays) {
  // Noise with values at the level itself: saddles and pinches everywhere.
  const auto domain = make_level_set(test::plateaus<std::uint8_t>({12, 12, 12}, {}), {1, InsideSide::above, {}});
  const Meshing meshing = meshing_of(*domain, 3);
  EXPECT_LT(meshing.conformance.places.size() + meshing.refined.tangled.size(), 10U);
  for (const FinerPlace& place : meshing.finer) EXPECT_LE(place.size_mm, 1.5);
}

TEST(Meshing, TimesAreThoseOfAllAttempts) {
  const auto domain = make_level_set(test::plateaus<std::uint8_t>({12, 12, 12}, {}), {1, InsideSide::above, {}});
  constexpr double kSteepDeg = 15;
  MesherOptions mesher;
  mesher.bounds.small_slack = 1;
  Progress progress;
  const Meshing meshing = *mesh_and_optimize(*domain, std::make_shared<UniformSize>(1.5), mesher,
                                             {Optimize::full, {.min_dihedral_deg = kSteepDeg}}, progress);
  ASSERT_FALSE(meshing.finer.empty()) << "the mesh is of a later attempt";
  const MeshResult& mesh = meshing.refined;
  ASSERT_EQ(mesh.stages.front().stage, "boundary sample");
  EXPECT_GE(mesh.sample_s, mesh.stages.front().seconds);
  EXPECT_GT(mesh.stages.front().seconds, 0);
  std::map<std::string, int> times;
  for (const StageAccount& stage : mesh.stages) EXPECT_EQ(++times[stage.stage], 1) << stage.stage;
  EXPECT_GT(meshing.optimize_s, 0);
}

}  // namespace
}  // namespace scantet
