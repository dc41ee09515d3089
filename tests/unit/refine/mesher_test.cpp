#include "scantet/refine/mesher.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "error_code.h"
#include "scantet/base/error.h"
#include "scantet/check/rules_check.h"
#include "scantet/domain/analytic.h"
#include "unit/cut_balls.h"
#include "unit/sharp_cube.h"

namespace scantet {
namespace {

double volume_mm3(const TetMesh& mesh) {
  double sum = 0;
  for (const Tet& t : mesh.tets) {
    sum += orientation_mm3(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]) / 6;
  }
  return sum;
}

MeshResult mesh_of(const Domain& domain, double size_mm, MesherOptions options = {}) {
  Progress progress;
  return mesh_domain(domain, UniformSize(size_mm), options, progress);
}

TEST(Mesher, ConvergesToTheVolume) {
  const auto sphere = make_sphere({1, 2, 3}, 10);
  const double truth = 4.0 / 3 * M_PI * 1000;
  const MeshResult coarse = mesh_of(*sphere, 3);
  const MeshResult fine = mesh_of(*sphere, 1.5);
  EXPECT_EQ(coarse.stop, Stop::converged);
  EXPECT_NEAR(volume_mm3(coarse.mesh), truth, 0.06 * truth);
  EXPECT_NEAR(volume_mm3(fine.mesh), truth, 0.02 * truth);
  EXPECT_LT(std::abs(volume_mm3(fine.mesh) - truth), std::abs(volume_mm3(coarse.mesh) - truth));
}

TEST(Mesher, LeavesNothingUnmetByItsOwnCountOrAFreshOne) {
  for (const auto& domain : {make_sphere({}, 10), make_torus({}, 10, 3), make_shell({}, 5, 10)}) {
    const MeshResult result = mesh_of(*domain, 2);
    EXPECT_EQ(result.counts.unmet.total(), 0U);
    EXPECT_EQ(check_rules(result.sample, result.sample_dimensions, *domain, UniformSize(2), {}).total(), 0U);
  }
}

TEST(Mesher, FreshCheckSeesAViolation) {
  const auto sphere = make_sphere({}, 10);
  MeshResult result = mesh_of(*sphere, 2);
  const UnmetRules finer = check_rules(result.sample, result.sample_dimensions, *sphere, UniformSize(1), {});
  EXPECT_GT(finer.r2, 0U);
  EXPECT_GT(finer.r3, 0U);
  result.sample_dimensions.assign(result.sample.size(), 3);
  EXPECT_GT(check_rules(result.sample, result.sample_dimensions, *sphere, UniformSize(2), {}).r1, 0U);
}

TEST(Mesher, CountsEveryInsertedPoint) {
  for (const Seeding seeding : {Seeding::bulk, Seeding::paper}) {
    MesherOptions options;
    options.seeding = seeding;
    const MeshResult r = mesh_of(*make_torus({}, 10, 3), 1.5, options);
    EXPECT_EQ(r.counts.initial_points + r.counts.lattice_points + r.counts.repair_points + r.counts.inserted.r1 +
                  r.counts.inserted.r2 + r.counts.inserted.r3_1 + r.counts.inserted.r3_2,
              r.sample.size());
    EXPECT_EQ(r.counts.lattice_points > 0, seeding == Seeding::bulk);
    EXPECT_EQ(r.counts.unmet.total(), 0U);
  }
}

TEST(Mesher, RefinesFurtherWhereTheSizeBecameSmaller) {
  const auto sphere = make_sphere({}, 10);
  const MeshResult before = mesh_of(*sphere, 5);
  const FinerSize finer(std::make_shared<UniformSize>(5), {{{10, 0, 0}, 0.5}});
  Progress progress;
  const MeshResult after = refine_further(*sphere, finer, {}, before, progress);
  EXPECT_EQ(after.stop, Stop::converged);
  EXPECT_EQ(check_rules(after.sample, after.sample_dimensions, *sphere, finer, {}).total(), 0U);
  EXPECT_EQ(after.counts.initial_points + after.counts.lattice_points, before.sample.size());
  EXPECT_GT(after.sample.size(), before.sample.size());
  std::vector<Point> points = after.sample;
  std::sort(points.begin(), points.end(), lexicographically_less);
  const auto is_kept = [&](const Point& p) {
    return std::binary_search(points.begin(), points.end(), p, lexicographically_less);
  };
  EXPECT_TRUE(std::all_of(before.sample.begin(), before.sample.end(), is_kept));
  for (const Point& p : after.sample) {
    const bool far = distance(p, {10, 0, 0}) > 10;
    EXPECT_TRUE(!far || std::find(before.sample.begin(), before.sample.end(), p) != before.sample.end());
  }
}

TEST(Mesher, FacetDistanceIsRespected) {
  const auto sphere = make_sphere({}, 10);
  MesherOptions options;
  options.bounds.facet_distance_mm = 0.02;
  const MeshResult fine = mesh_of(*sphere, 4, options);
  EXPECT_EQ(fine.stop, Stop::converged);
  EXPECT_GT(fine.mesh.boundary_facets.size(), mesh_of(*sphere, 4).mesh.boundary_facets.size());
  for (const Triangle& f : fine.mesh.boundary_facets) {
    // The sagitta of a facet of a sphere is the distance of its circumcentre to the ball's centre.
    const Point a = fine.mesh.vertices[f[0]];
    const Vec n = cross(fine.mesh.vertices[f[1]] - a, fine.mesh.vertices[f[2]] - a);
    EXPECT_LE(10 - std::abs(dot(a, n)) / length(n), 0.02 + 1e-9);
  }
}

TEST(Mesher, KeepsCloseComponentsApart) {
  const auto spheres = make_two_spheres(5, 0.05);
  const MeshResult result = mesh_of(*spheres, 2);
  EXPECT_EQ(result.stop, Stop::converged);
  for (const Tet& t : result.mesh.tets) {
    int left = 0;
    for (VertexId v : t) left += result.mesh.vertices[v].x < 0 ? 1 : 0;
    EXPECT_TRUE(left == 0 || left == 4) << "a tet joins the two spheres";
  }
}

TEST(Mesher, PointsOnPlanesOfAGridDoNotUpsetIt) {
  // Crossings of grid lines with a sphere: many are coplanar to the last bits, and flat tets on the hull have their
  // circumcentre 1e16 mm away.
  for (const double size_mm : {2.5, 1.5, 1.1}) {
    const MeshResult result = mesh_of(*make_sphere({0.5, 0.5, 0.5}, 8), size_mm);
    EXPECT_EQ(result.stop, Stop::converged);
    EXPECT_EQ(result.counts.unmet.total(), 0U);
  }
}

/// Answers the two questions of the paper's oracle and nothing else.
class TwoQueries final : public Domain {
 public:
  explicit TwoQueries(std::unique_ptr<Domain> domain) : domain_(std::move(domain)) {}
  Box bounds() const override { return domain_->bounds(); }
  Region region_at(const Point& p) const override { return domain_->region_at(p); }
  void crossings(const Segment& segment, Crossings& out) const override { domain_->crossings(segment, out); }

 private:
  std::unique_ptr<Domain> domain_;
};

TEST(Mesher, TwoQueriesAreEnough) {
  const TwoQueries spheres(make_two_spheres(1, 1));
  const MeshResult result = mesh_of(spheres, 0.2);
  EXPECT_EQ(result.stop, Stop::converged);
  EXPECT_EQ(result.counts.absorbed_tets, 0U) << "what is not known to be a fragment is not taken for one";
  EXPECT_NEAR(volume_mm3(result.mesh), 2 * 4.0 / 3 * M_PI, 0.4);
}

TEST(Mesher, StopsAtTheVertexLimitAndSaysWhere) {
  MesherOptions options;
  options.max_vertices = 2000;
  const MeshResult seeded = mesh_of(*make_sphere({}, 10), 0.8, options);
  EXPECT_EQ(seeded.stop, Stop::limit);
  EXPECT_LE(seeded.sample.size(), 2000U);
  ASSERT_TRUE(seeded.limit.has_value());
  EXPECT_EQ(seeded.limit->rule, "initial sample");

  options.seeding = Seeding::paper;
  const MeshResult result = mesh_of(*make_sphere({}, 10), 0.8, options);
  EXPECT_EQ(result.stop, Stop::limit);
  EXPECT_LE(result.sample.size(), 2000U);
  EXPECT_GT(result.counts.unmet.total(), 0U);
  ASSERT_TRUE(result.limit.has_value());
  EXPECT_EQ(result.limit->rule, "R3.1");
  EXPECT_LE(length(result.limit->place), 10.1);
  EXPECT_GT(result.limit->insertion_radius_mm, 0);
}

TEST(Mesher, BoundsBelowTheTerminationThresholdDoNotHang) {
  MesherOptions options;
  options.bounds.facet_radius_edge = 0.6;  // an equilateral triangle has 0.577: no Delaunay refinement can do this
  options.bounds.cell_radius_edge = 0.7;
  options.max_vertices = 20000;
  EXPECT_EQ(mesh_of(*make_sphere({}, 10), 3, options).stop, Stop::limit);
}

/// Cancels after some reports.
class CancelSoon final : public Progress {
 public:
  void report(const ProgressState& state) override { refining_ = state.stage == "refine"; }
  bool cancelled() const override { return refining_; }

 private:
  bool refining_ = false;
};

TEST(Mesher, CancelledRunReturnsNoMesh) {
  CancelSoon progress;
  MesherOptions options;
  options.seeding = Seeding::paper;  // leaves the rules thousands of points to insert
  const MeshResult result = mesh_domain(*make_sphere({}, 10), UniformSize(0.8), options, progress);
  EXPECT_EQ(result.stop, Stop::cancelled);
  EXPECT_TRUE(result.mesh.tets.empty());
}

/// Out of budget once the rules are at work.
class ShortBudget final : public Progress {
 public:
  void report(const ProgressState& state) override { over_ = over_ || state.stage == "refine"; }
  bool cancelled() const override { return over_; }
  bool out_of_budget() const override { return over_; }

 private:
  bool over_ = false;
};

TEST(Mesher, RunOutOfBudgetReturnsTheMeshByThen) {
  ShortBudget progress;
  MesherOptions options;
  options.seeding = Seeding::paper;
  const MeshResult result = mesh_domain(*make_sphere({}, 10), UniformSize(0.8), options, progress);
  EXPECT_EQ(result.stop, Stop::limit);
  EXPECT_GT(result.counts.unmet.total(), 0U);
  EXPECT_FALSE(result.mesh.tets.empty());
  EXPECT_NEAR(volume_mm3(result.mesh), 4.0 / 3 * M_PI * 1000, 100);
}

TEST(Mesher, BoundaryThatTakesMoreThanTheLimitIsRefused) {
  MesherOptions options;
  options.max_vertices = 200;
  try {
    mesh_of(*make_sphere({}, 10), 0.8, options);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), "usage.max_vertices");
  }
}

TEST(Mesher, SamplingThatWouldNotEndIsRefused) {
  MesherOptions options;
  options.max_vertices = 2000;
  for (const double size : {0.01, 1e-4}) {  // too many candidates; too many lines
    try {
      mesh_of(*make_sphere({}, 10), size, options);
      ADD_FAILURE() << size;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), "usage.size") << size;
    }
  }
}

/// A ball that gives points of its equator alone to start from.
class Equator final : public Domain {
 public:
  Box bounds() const override { return ball_->bounds(); }
  Region region_at(const Point& p) const override { return ball_->region_at(p); }
  void crossings(const Segment& segment, Crossings& out) const override { ball_->crossings(segment, out); }
  void surface_candidates(double, const PointSink& sink) const override {
    for (const Point& p : {Point{10, 0, 0}, {0, 10, 0}, {-10, 0, 0}, {0, -10, 0}}) sink(p);
  }

 private:
  std::unique_ptr<Domain> ball_ = make_sphere({}, 10);
};

TEST(Mesher, PointsInAPlaneAreRefused) {
  MesherOptions options;
  options.seeding = Seeding::paper;
  EXPECT_EQ(test::error_code([&] { mesh_of(Equator(), 8, options); }), "input.flat");
}

TEST(Mesher, RunsAreIdentical) {
  const auto torus = make_torus({}, 10, 3);
  const MeshResult a = mesh_of(*torus, 1.5);
  const MeshResult b = mesh_of(*torus, 1.5);
  EXPECT_EQ(a.mesh.vertices, b.mesh.vertices);
  EXPECT_EQ(a.mesh.tets, b.mesh.tets);
  EXPECT_EQ(a.mesh.boundary_facets, b.mesh.boundary_facets);
}

TEST(Mesher, RefusesNonsense) {
  const auto sphere = make_sphere({}, 10);
  MesherOptions options;
  for (double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(mesh_of(*sphere, bad), Error);
    options.bounds.alpha = bad;
    EXPECT_THROW(mesh_of(*sphere, 1, options), Error);
    options = {};
    options.bounds.facet_distance_mm = bad;
    EXPECT_THROW(mesh_of(*sphere, 1, options), Error);
    options = {};
    options.bounds.small_slack = bad;
    EXPECT_THROW(mesh_of(*sphere, 1, options), Error);
    options = {};
  }
  options.bounds.small_slack = 0.99;
  EXPECT_THROW(mesh_of(*sphere, 1, options), Error);
}

TEST(Mesher, SmallElementsGetSlackWhereThereAreNoJunctions) {
  MesherOptions strict;
  strict.bounds.small_slack = 1;
  const auto thin = make_torus({}, 10, 0.4);  // thinner than the size
  EXPECT_LT(mesh_of(*thin, 4).mesh.vertices.size(),
            0.9 * static_cast<double>(mesh_of(*thin, 4, strict).mesh.vertices.size()));
  const test::CutBall parted(10, 3);
  EXPECT_EQ(mesh_of(parted, 4).mesh.vertices, mesh_of(parted, 4, strict).mesh.vertices);
  EXPECT_EQ(bounds_on(parted, {}).small_slack, 1);
  EXPECT_EQ(bounds_on(*thin, {}).small_slack, RuleBounds{}.small_slack);
  EXPECT_EQ(bounds_on(test::SharpCube(20), {}).small_slack, RuleBounds{}.small_slack) << "edges, and no junctions";
}

}  // namespace
}  // namespace scantet
