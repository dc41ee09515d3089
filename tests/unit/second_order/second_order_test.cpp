// Meshes of second order: how well they follow a ball, and that nothing turns over.
#include "scantet/second_order/second_order.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cancelled_after.h"
#include "error_code.h"
#include "scantet/base/mesh_order.h"
#include "scantet/base/mesh_topology.h"
#include "scantet/base/parallel.h"
#include "scantet/domain/analytic.h"
#include "scantet/domain/sizing_field.h"
#include "scantet/optimize/optimizer.h"
#include "scantet/refine/mesher.h"
#include "scantet/second_order/jacobian.h"

namespace scantet {
namespace {

constexpr double kRadius = 10;

TetMesh meshed(const Domain& domain, double size_mm) {
  Progress progress;
  const UniformSize size(size_mm);
  TetMesh mesh = mesh_domain(domain, size, {}, progress).mesh;
  OptimizerOptions options;
  options.optimize = Optimize::full;
  options.bounds.min_dihedral_deg = 10;
  optimize_mesh(mesh, domain, options, progress);
  return mesh;
}

TEST(SecondOrder, VolumeOfABallConvergesWithTheFourthPower) {
  const auto ball = make_sphere({1, 2, 3}, kRadius);
  const double exact = 4 * std::numbers::pi / 3 * kRadius * kRadius * kRadius;
  Progress progress;
  std::array<double, 2> first{};
  std::array<double, 2> second{};
  std::array<double, 2> edge{};
  const std::array<double, 2> sizes{4, 1.25};
  for (std::size_t i = 0; i < 2; ++i) {
    TetMesh mesh = meshed(*ball, sizes[i]);
    first[i] = std::abs(curved_volume_mm3(mesh) - exact);
    edge[i] = std::sqrt(1.0 / static_cast<double>(mesh.boundary_facets.size()));  // of the mean facet
    const SecondOrderCounts counts = make_second_order(mesh, *ball, progress);
    EXPECT_EQ(counts.unproved, 0u);
    EXPECT_EQ(counts.off_boundary, 0u);
    EXPECT_EQ(counts.eased_tets, 0u);
    EXPECT_NEAR(counts.volume_mm3, curved_volume_mm3(mesh), 1e-9 * exact);
    second[i] = std::abs(counts.volume_mm3 - exact);
  }
  const double ratio = std::log(edge[0] / edge[1]);
  EXPECT_GE(std::log(first[0] / first[1]) / ratio, 1.9);
  EXPECT_GE(std::log(second[0] / second[1]) / ratio, 3.5);
  EXPECT_LT(second[1], 1e-2 * first[1]);
}

TEST(SecondOrder, NodesOfBoundaryEdgesAreOnTheBoundaryAndTheOthersInTheMiddle) {
  const auto ball = make_sphere({0, 0, 0}, kRadius);
  TetMesh mesh = meshed(*ball, 4);
  const std::size_t corners = mesh.vertices.size();
  Progress progress;
  const SecondOrderCounts counts = make_second_order(mesh, *ball, progress);
  ASSERT_EQ(mesh.tet_edge_vertices.size(), mesh.tets.size());
  ASSERT_EQ(mesh.vertices.size(), corners + counts.edges);
  ASSERT_EQ(mesh.strata.size(), mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t e = 0; e < 6; ++e) {
      const VertexId v = mesh.tet_edge_vertices[t][e];
      const Point& a = mesh.vertices[mesh.tets[t][kEdgesOfNodes[e][0]]];
      const Point& b = mesh.vertices[mesh.tets[t][kEdgesOfNodes[e][1]]];
      if (mesh.on_boundary(v)) {
        EXPECT_NEAR(length(mesh.vertices[v]), kRadius, 1e-9);
      } else {
        EXPECT_EQ(mesh.vertices[v], 0.5 * (a + b));
      }
    }
  }
}

TEST(SecondOrder, WhatIsMeasuredOfAFinishedMeshIsWhatWasCounted) {
  const auto ball = make_sphere({0, 0, 0}, kRadius);
  TetMesh mesh = meshed(*ball, 4);
  const TetMesh corners = mesh;
  Progress progress;
  const SecondOrderCounts made = make_second_order(mesh, *ball, progress);
  const SecondOrderCounts measured = measure_second_order(mesh);
  EXPECT_EQ(measured.edges, made.edges);
  EXPECT_EQ(measured.boundary_edges, made.boundary_edges);
  EXPECT_EQ(measured.unproved, 0u);
  EXPECT_NEAR(measured.volume_mm3, made.volume_mm3, 1e-9 * made.volume_mm3);
  EXPECT_LE(measured.least_share, made.least_share + 1e-12) << "without the halves that prove more";

  TetMesh again = mesh;
  set_strata(again);
  EXPECT_EQ(again.strata, mesh.strata) << "as they were made";
  const TetMesh straight = first_order(mesh);
  EXPECT_EQ(straight.vertices, corners.vertices);
  EXPECT_EQ(straight.tets, corners.tets);
  EXPECT_EQ(straight.boundary_facets, corners.boundary_facets);
  EXPECT_EQ(straight.strata, corners.strata);
}

TEST(SecondOrder, ATetThatIsTurnedOverIsNotProved) {
  TetMesh mesh;
  mesh.vertices = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 0, 0},
                   {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  mesh.tets = {{0, 1, 2, 3}};
  mesh.tet_regions = {1};
  mesh.tet_edge_vertices = {{4, 5, 6, 7, 8, 9}};
  build_boundary(mesh);
  EXPECT_EQ(measure_second_order(mesh).unproved, 0u);
  EXPECT_NEAR(measure_second_order(mesh).least_share, 1, 1e-9);
  mesh.vertices[4] = {1, 3, 3};  // the edge's node beyond the other side
  EXPECT_EQ(measure_second_order(mesh).unproved, 1u);
}

TEST(SecondOrder, TetsThatWouldTurnOverAreEasedAndCounted) {
  const auto ball = make_sphere({0, 0, 0}, kRadius);
  TetMesh mesh;  // one tet far too large for the ball: its edges bulge by more than their tet can take
  mesh.vertices = {{0, 0, 10}, {9.428, 0, -3.333}, {-4.714, 8.165, -3.333}, {-4.714, -8.165, -3.333}};
  // Pushed nearly flat.
  mesh.vertices[0] = {0, 0, -2.9};
  mesh.tets = {{0, 1, 3, 2}};
  mesh.tet_regions = {1};
  const auto& p = mesh.vertices;
  if (orientation_mm3(p[0], p[1], p[3], p[2]) < 0) mesh.tets = {{0, 1, 2, 3}};
  const Tet tet = mesh.tets[0];
  mesh.boundary_facets = {
      {tet[1], tet[2], tet[3]}, {tet[0], tet[3], tet[2]}, {tet[0], tet[1], tet[3]}, {tet[0], tet[2], tet[1]}};
  mesh.facet_regions.assign(4, {1, 0});
  mesh.facet_patches.assign(4, 0);
  mesh.patches = {{{1, 0}, {}}};
  mesh.strata.assign(4, {0, 2});
  Progress progress;
  const SecondOrderCounts counts = make_second_order(mesh, *ball, progress);
  EXPECT_EQ(counts.unproved, 0u);
  EXPECT_GE(counts.least_share, kLeastJacobianShare);
  TetNodes nodes;
  for (std::size_t i = 0; i < 4; ++i) nodes[i] = mesh.vertices[mesh.tets[0][i]];
  for (std::size_t e = 0; e < 6; ++e) nodes[4 + e] = mesh.vertices[mesh.tet_edge_vertices[0][e]];
  EXPECT_TRUE(TetJacobian(nodes).is_above(0));
}

TEST(SecondOrder, AMeshThatIsOfSecondOrderIsRefused) {
  const auto ball = make_sphere({0, 0, 0}, kRadius);
  TetMesh mesh = meshed(*ball, 6);
  Progress progress;
  make_second_order(mesh, *ball, progress);
  EXPECT_EQ(test::error_code([&] { make_second_order(mesh, *ball, progress); }), "mesh.order");
}

TEST(SecondOrder, CancelledItLeavesTheMeshAsItWas) {
  const auto ball = make_sphere({0, 0, 0}, kRadius);
  const TetMesh before = meshed(*ball, 6);
  constexpr int kMany = 1 << 20;
  const test::CancelledAfter never(kMany);
  TetMesh whole = before;
  make_second_order(whole, *ball, never);
  ASSERT_FALSE(whole.tet_edge_vertices.empty());
  const int asked = kMany - never.left();
  for (int polls = 0; polls < asked; ++polls) {
    const test::CancelledAfter progress(polls);
    TetMesh mesh = before;
    EXPECT_EQ(make_second_order(mesh, *ball, progress).edges, 0U) << polls;
    EXPECT_EQ(mesh.vertices, before.vertices) << polls;
    EXPECT_TRUE(mesh.tet_edge_vertices.empty()) << polls;
  }
}

TEST(SecondOrder, AnyNumberOfThreadsGivesTheSameNodes) {
  const auto shell = make_shell({0, 0, 0}, 6, 10);
  const TetMesh mesh = meshed(*shell, 3);
  TetMesh one = mesh, four = mesh;
  Progress progress;
  with_threads(1, [&] { make_second_order(one, *shell, progress); });
  with_threads(4, [&] { make_second_order(four, *shell, progress); });
  EXPECT_EQ(one.vertices, four.vertices);
  EXPECT_EQ(one.tet_edge_vertices, four.tet_edge_vertices);
}

}  // namespace
}  // namespace scantet
