// Distances between the boundaries of a mesh and its domain: what is known of them lies between the bounds.
#include "scantet/check/distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scantet/base/mesh_topology.h"
#include "scantet/base/parallel.h"
#include "scantet/check/facet_tree_impl.h"
#include "scantet/domain/analytic.h"
#include "scantet/image/kept_components.h"
#include "scantet/image/level_set.h"
#include "scantet/image/nested_level_sets.h"
#include "scantet/refine/mesher.h"
#include "unit/image/test_scan.h"

namespace scantet {
namespace {

constexpr int kSize = 24;

/// A ball of radius 7 voxels around the middle: the level is 0.
Scan ball_scan(const Frame& frame = {}) {
  return test::scan_of_function<float>(
      {kSize, kSize, kSize}, [](int i, int j, int k) { return 7 - std::hypot(i - 11.4, j - 11.6, k - 11.5); }, frame);
}

std::unique_ptr<Domain> level_set(const Scan& scan, double level = 0) {
  LevelSetSettings settings;
  settings.level = level;
  return make_level_set(scan, settings);
}

TetMesh mesh_of(const Domain& domain, double size_mm) {
  Progress progress;
  return mesh_domain(domain, UniformSize(size_mm), {}, progress).mesh;
}

/// The greatest distance of many points of the domain's boundary from the mesh's.
double sampled_to_mesh(const TetMesh& mesh, const Domain& domain, double spacing_mm) {
  const FacetTree tree(mesh, all_facets(mesh));
  double greatest = 0;
  domain.surface_candidates(spacing_mm,
                            [&](const Point& p) { greatest = std::max(greatest, tree.nearest(p).distance_mm); });
  return greatest;
}

/// The greatest distance of many points of the facets from points of the domain's boundary, which is too great by less
/// than the spacing of these.
double sampled_to_domain(const TetMesh& mesh, const Domain& domain, double spacing_mm) {
  std::vector<Point> surface;
  domain.surface_candidates(spacing_mm, [&](const Point& p) { surface.push_back(p); });
  double greatest = 0;
  for (const Triangle& t : mesh.boundary_facets) {
    for (int n = 0; n < 10; ++n) {
      const double u = 0.1 + 0.08 * n;
      const double v = (1 - u) * (0.1 + 0.08 * ((7 * n) % 10));
      const Point p = (1 - u - v) * mesh.vertices[t[0]] + u * mesh.vertices[t[1]] + v * mesh.vertices[t[2]];
      double nearest = 1e300;
      for (const Point& q : surface) nearest = std::min(nearest, squared_distance(p, q));
      greatest = std::max(greatest, std::sqrt(nearest));
    }
  }
  return greatest;
}

void expect_tight(const OneWayDistance& d, double tolerance) {
  ASSERT_TRUE(d.upper_mm.has_value());
  EXPECT_LE(d.lower_mm, *d.upper_mm);
  EXPECT_LE(*d.upper_mm, (1 + tolerance) * d.lower_mm * 1.05);  // some boxes are too small to be divided
  ASSERT_FALSE(d.worst.empty());
  EXPECT_EQ(d.worst.front().distance_mm, d.lower_mm);
  for (std::size_t i = 1; i < d.worst.size(); ++i) EXPECT_GE(d.worst[i - 1].distance_mm, d.worst[i].distance_mm);
}

TEST(FacetTree, FindsTheNearestFacet) {
  const auto domain = level_set(ball_scan());
  const TetMesh mesh = mesh_of(*domain, 3);
  const FacetTree tree(mesh, all_facets(mesh));
  std::mt19937 random(7);
  FacetTree::Nearest last;
  for (int n = 0; n < 300; ++n) {
    const Point p = test::random_index({kSize, kSize, kSize}, random);
    double nearest = 1e300;
    for (std::size_t i = 0; i < mesh.boundary_facets.size(); ++i)
      nearest = std::min(nearest, distance(p, nearest_on_triangle(p, corners_of(mesh, i))));
    EXPECT_DOUBLE_EQ(tree.nearest(p).distance_mm, nearest);
    last = tree.nearest(p, last.facet);
    EXPECT_DOUBLE_EQ(last.distance_mm, nearest);
    EXPECT_DOUBLE_EQ(tree.distance_to(last.facet, p), nearest);
  }
}

TEST(Distance, BoundsHoldWhatManyPointsSay) {
  for (const auto& [name, frame] : test::frames()) {
    SCOPED_TRACE(name);
    const auto domain = level_set(ball_scan(frame));
    const TetMesh mesh = mesh_of(*domain, 3);
    const BoundaryDistance found = measure_distance(mesh, *domain);
    EXPECT_TRUE(found.proved());
    expect_tight(found.to_mesh, 0.25);
    expect_tight(found.to_domain, 0.25);
    const double to_mesh = sampled_to_mesh(mesh, *domain, 0.4);
    EXPECT_LE(to_mesh, *found.to_mesh.upper_mm);
    EXPECT_LE(found.to_mesh.lower_mm, 1.1 * to_mesh + 0.02);
    const double to_domain = sampled_to_domain(mesh, *domain, 0.4);
    EXPECT_LE(to_domain - 0.4, *found.to_domain.upper_mm);
    EXPECT_LE(found.to_domain.lower_mm, 1.1 * to_domain + 0.02);
    const BoundaryDistance closer = measure_distance(mesh, *domain, {std::nullopt, 0.05});
    expect_tight(closer.to_mesh, 0.05);
    expect_tight(closer.to_domain, 0.05);
  }
}

TEST(Distance, OfAMeshThatWasMoved) {
  const auto domain = level_set(ball_scan());
  TetMesh mesh = mesh_of(*domain, 2);
  for (Point& p : mesh.vertices) p.x += 2;
  const BoundaryDistance found = measure_distance(mesh, *domain);
  for (const OneWayDistance& way : {found.to_mesh, found.to_domain}) {
    expect_tight(way, 0.25);
    EXPECT_GE(*way.upper_mm, 1.95);
    EXPECT_LE(way.lower_mm, 2.2);
    EXPECT_GE(way.lower_mm, 1.8);
    EXPECT_NEAR(way.worst.front().point.x, found.to_mesh.worst.front().point.x < 11 ? 5 : 19, 3);
  }
}

/// Two sheets, 4 voxels thick and 6 apart.
std::unique_ptr<Domain> two_sheets() {
  return level_set(test::scan_of_function<float>({30, 30, kSize}, [](int i, int j, int k) {
    const double across = std::max(std::abs(i - 14.5), std::abs(j - 14.5)) - 11.3;
    const double sheet = std::min(std::abs(k - 6.3), std::abs(k - 16.3)) - 2;
    return -std::max(across, sheet);
  }));
}

TetMesh without_upper_sheet(TetMesh mesh) {
  const auto upper = [&](const Tet& t) {
    return std::all_of(t.begin(), t.end(), [&](VertexId v) { return mesh.vertices[v].z > 11; });
  };
  std::erase_if(mesh.tets, upper);
  mesh.tet_regions.resize(mesh.tets.size(), 1);
  build_boundary(mesh);
  return mesh;
}

TEST(Distance, ASheetThatTheMeshHasNotIsTold) {
  const auto domain = two_sheets();
  const TetMesh mesh = without_upper_sheet(mesh_of(*domain, 2));
  const BoundaryDistance found = measure_distance(mesh, *domain, {1.0, 0.1});
  EXPECT_NEAR(found.to_mesh.lower_mm, 10, 0.6) << "from the far side of the missing sheet";
  EXPECT_GT(found.to_mesh.worst.front().point.z, 17.5);
  EXPECT_LT(*found.to_domain.upper_mm, 2);
  EXPECT_GT(found.to_mesh.beyond.size(), 1000U);
  EXPECT_TRUE(std::all_of(found.to_mesh.beyond.begin(), found.to_mesh.beyond.end(),
                          [](const FarPlace& place) { return place.distance_mm > 1 || place.distance_mm == 0; }));
}

TEST(Distance, ALimitIsProvedOrBroken) {
  const auto domain = level_set(ball_scan());
  const TetMesh mesh = mesh_of(*domain, 3);
  const BoundaryDistance free = measure_distance(mesh, *domain, {std::nullopt, 0.05});
  const double both = std::max(*free.to_mesh.upper_mm, *free.to_domain.upper_mm);
  const BoundaryDistance kept = measure_distance(mesh, *domain, {1.01 * both, 0.25});
  EXPECT_TRUE(kept.to_mesh.beyond.empty());
  EXPECT_TRUE(kept.to_domain.beyond.empty());
  EXPECT_LE(*kept.to_mesh.upper_mm, 1.01 * both);
  const double low = 0.5 * std::min(free.to_mesh.lower_mm, free.to_domain.lower_mm);
  const BoundaryDistance broken = measure_distance(mesh, *domain, {low, 0.25});
  for (const OneWayDistance& way : {broken.to_mesh, broken.to_domain}) {
    EXPECT_GT(way.beyond.size(), 0U);
    EXPECT_LT(way.undecided, way.beyond.size());
    EXPECT_GE(way.parts, way.beyond.size());
    const auto is_proved = [&](const FarPlace& place) { return place.distance_mm > low; };
    const auto proved = std::count_if(way.beyond.begin(), way.beyond.end(), is_proved);
    EXPECT_EQ(static_cast<std::uint64_t>(proved), way.beyond.size() - way.undecided);
  }
}

// The second mesh lacks a sheet that the first one has, the third one has it again, and some vertices moved.
TEST(Distance, AMeterForgetsNothingThatChanged) {
  const auto domain = two_sheets();
  const TetMesh whole = mesh_of(*domain, 2);
  const TetMesh lacking = without_upper_sheet(whole);
  TetMesh moved = whole;
  for (std::size_t v = 0; v < moved.vertices.size(); v += 97) moved.vertices[v].z += 0.8;
  constexpr double kLimit = 1;
  DistanceMeter meter(*domain, kLimit);
  for (const TetMesh* const mesh : std::vector<const TetMesh*>{&whole, &lacking, &lacking, &whole, &moved, &whole}) {
    const BoundaryDistance anew = measure_distance(*mesh, *domain, {.limit_mm = kLimit});
    const BoundaryDistance after = meter.measure(*mesh);
    EXPECT_EQ(after.to_mesh.beyond.size(), anew.to_mesh.beyond.size());
    EXPECT_EQ(after.to_domain.beyond.size(), anew.to_domain.beyond.size());
    EXPECT_GE(*after.to_mesh.upper_mm, sampled_to_mesh(*mesh, *domain, 0.5));
    EXPECT_LE(*after.to_mesh.upper_mm, 1.3 * anew.to_mesh.lower_mm);
    EXPECT_LE(*after.to_domain.upper_mm, 1.3 * anew.to_domain.lower_mm);
  }
}

TEST(Distance, AMeterIsQuickerWithWhatItKnows) {
  const auto domain = level_set(ball_scan());
  const TetMesh mesh = mesh_of(*domain, 3);
  DistanceMeter meter(*domain, 1.01 * measure_distance(mesh, *domain).to_mesh.lower_mm);
  const BoundaryDistance first = meter.measure(mesh);
  const BoundaryDistance again = meter.measure(mesh);
  EXPECT_LT(again.to_mesh.points, first.to_mesh.points);
  EXPECT_EQ(again.to_mesh.upper_mm, first.to_mesh.upper_mm);
  EXPECT_EQ(again.to_domain.upper_mm, first.to_domain.upper_mm);
  EXPECT_EQ(again.to_domain.lower_mm, first.to_domain.lower_mm);
}

TEST(Distance, DoesNotDependOnTheThreads) {
  const auto domain = level_set(test::noisy_ball<float>({20, 18, 16}, Frame()), 50);
  const TetMesh mesh = mesh_of(*domain, 2);
  std::vector<BoundaryDistance> found;
  for (const std::size_t threads : {1, 2, 4}) {
    with_threads(threads, [&] { found.push_back(measure_distance(mesh, *domain, {0.3, 0.1})); });
  }
  EXPECT_GT(found[0].to_mesh.points, 300U);
  EXPECT_EQ(found[0], found[1]);
  EXPECT_EQ(found[0], found[2]);
  EXPECT_LE(sampled_to_mesh(mesh, *domain, 0.5), *found[0].to_mesh.upper_mm);
}

TEST(Distance, OfSeveralLevelsEachFromItsOwn) {
  NestedLevelSettings settings;
  settings.levels = {0, 3};
  const auto domain = make_nested_level_sets(ball_scan(), settings);
  TetMesh mesh = mesh_of(*domain, 2);
  const BoundaryDistance found = measure_distance(mesh, *domain);
  expect_tight(found.to_mesh, 0.25);
  expect_tight(found.to_domain, 0.25);
  EXPECT_LT(*found.to_mesh.upper_mm, 1.0);
  for (Region& region : mesh.tet_regions) region = 1;  // without the inner one
  build_boundary(mesh);
  const BoundaryDistance without = measure_distance(mesh, *domain);
  EXPECT_NEAR(without.to_mesh.lower_mm, 3, 0.3);
}

TEST(Distance, ComponentsLeftOutAreNotMissed) {
  // Two balls that share a cell at most, of which the smaller one is left out.
  const Scan scan = test::scan_of_function<float>({kSize, kSize, kSize}, [](int i, int j, int k) {
    return std::max(6 - std::hypot(i - 8.0, j - 8.0, k - 11.0), 3 - std::hypot(i - 14.9, j - 14.9, k - 11.0));
  });
  NestedLevelSettings settings;
  settings.levels = {0};
  const KeptLevelSets kept = make_kept_level_sets(scan, settings, keep_components(scan, settings, {1, 0}), 0);
  ASSERT_NE(kept.domain, nullptr);
  const TetMesh mesh = mesh_of(*kept.domain, 2);
  const BoundaryDistance found = measure_distance(mesh, *kept.domain);
  expect_tight(found.to_mesh, 0.25);
  EXPECT_LT(*found.to_mesh.upper_mm, 1.0);
}

TEST(Distance, OfADomainThatKnowsNoCellsIsMeasuredAtPoints) {
  const auto ball = make_sphere({1, 2, 3}, 10);
  const TetMesh mesh = mesh_of(*ball, 3);
  const BoundaryDistance found = measure_distance(mesh, *ball, {0.01, 0.25});
  EXPECT_FALSE(found.proved());
  EXPECT_GT(found.to_mesh.points, mesh.boundary_facets.size() / 4);
  EXPECT_EQ(found.to_domain.points, mesh.boundary_facets.size());
  double sagitta = 0;
  for (const Triangle& t : mesh.boundary_facets) {
    const Point center = 1.0 / 3 * (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]);
    sagitta = std::max(sagitta, 10 - distance(center, {1, 2, 3}));
  }
  EXPECT_NEAR(found.to_domain.lower_mm, sagitta, 1e-3);
  EXPECT_NEAR(found.to_mesh.lower_mm, sagitta, 0.2 * sagitta);
  EXPECT_FALSE(found.to_mesh.beyond.empty());
}

}  // namespace
}  // namespace scantet
