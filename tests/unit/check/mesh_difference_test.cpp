// What two meshes have in common does not depend on how they are numbered; distances lie between their bounds.
#include "scantet/check/mesh_difference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "scantet/base/mesh_topology.h"
#include "scantet/base/parallel.h"
#include "scantet/domain/analytic.h"
#include "scantet/refine/mesher.h"

namespace scantet {
namespace {

TetMesh ball(double radius_mm, double size_mm) {
  Progress progress;
  const auto domain = make_sphere({1, 2, 3}, radius_mm);
  return mesh_domain(*domain, UniformSize(size_mm), {}, progress).mesh;
}

// The same mesh with its vertices and tets in another order.
TetMesh renumbered(const TetMesh& mesh) {
  std::mt19937 random(5);
  std::vector<VertexId> place(mesh.vertices.size());
  std::iota(place.begin(), place.end(), 0U);
  std::shuffle(place.begin(), place.end(), random);
  std::vector<std::size_t> order(mesh.tets.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), random);
  TetMesh other;
  other.vertices.resize(mesh.vertices.size());
  for (std::size_t v = 0; v < place.size(); ++v) other.vertices[place[v]] = mesh.vertices[v];
  for (const std::size_t i : order) {
    const Tet& t = mesh.tets[i];
    other.tets.push_back({place[t[1]], place[t[2]], place[t[0]], place[t[3]]});
    other.tet_regions.push_back(mesh.tet_regions[i]);
  }
  build_boundary(other);
  return other;
}

void expect_no_distance(const MeshDifference& found) {
  for (const OneWayDistance* way : {&found.to_second, &found.to_first}) {
    EXPECT_EQ(way->lower_mm, 0);
    ASSERT_TRUE(way->upper_mm.has_value());
    EXPECT_LE(*way->upper_mm, 1e-12);
  }
}

TEST(MeshDifference, AMeshIsTheSameAsItself) {
  const TetMesh mesh = ball(10, 3);
  const MeshDifference found = compare_meshes(mesh, mesh);
  EXPECT_EQ(found.same, Sameness::arrays);
  expect_no_distance(found);
  ASSERT_EQ(found.regions.size(), 1u);
  EXPECT_EQ(found.regions[0].sides[0].tets, mesh.tets.size());
  ASSERT_EQ(found.patches.size(), 1u);
  EXPECT_EQ(found.patches[0].facets[1], mesh.boundary_facets.size());
}

TEST(MeshDifference, NumberingDoesNotMatter) {
  const TetMesh mesh = ball(10, 3);
  const MeshDifference found = compare_meshes(mesh, renumbered(mesh));
  EXPECT_EQ(found.same, Sameness::numbering);
  EXPECT_EQ(found.tets_alone, (std::array<std::uint64_t, 2>{0, 0}));
  expect_no_distance(found);
}

TEST(MeshDifference, OtherRegionsAreToldApartFromOtherTets) {
  const TetMesh mesh = ball(10, 3);
  TetMesh other = renumbered(mesh);
  for (std::size_t i = 0; i < other.tets.size(); i += 2) other.tet_regions[i] = 7;
  build_boundary(other);
  const MeshDifference found = compare_meshes(mesh, other);
  EXPECT_EQ(found.same, Sameness::tets);
  ASSERT_EQ(found.regions.size(), 2u);
  EXPECT_EQ(found.regions[1].region, 7);
  EXPECT_EQ(found.regions[1].sides[0].tets, 0u);
  EXPECT_EQ(found.regions[1].sides[1].tets, (mesh.tets.size() + 1) / 2);
}

TEST(MeshDifference, AMovedVertexIsFoundAndMeasured) {
  const TetMesh mesh = ball(10, 3);
  TetMesh other = mesh;
  const VertexId v = mesh.boundary_facets.front()[0];
  const Vec out = mesh.vertices[v] - Point{1, 2, 3};
  other.vertices[v] = mesh.vertices[v] + 0.5 / length(out) * out;
  const MeshDifference found = compare_meshes(mesh, other);
  EXPECT_EQ(found.same, Sameness::none);
  EXPECT_GT(found.tets_alone[0], 0u);
  EXPECT_EQ(found.tets_alone[0], found.tets_alone[1]);
  EXPECT_LT(found.tets_alone[0], mesh.tets.size() / 2);
  EXPECT_LE(found.to_first.lower_mm, 0.5 + 1e-12);
  EXPECT_GT(found.to_first.lower_mm, 0.4);
  EXPECT_GE(*found.to_first.upper_mm, found.to_first.lower_mm);
  EXPECT_LE(*found.to_first.upper_mm, 1.3 * found.to_first.lower_mm);
  ASSERT_FALSE(found.to_first.worst.empty());
  EXPECT_EQ(found.to_first.worst.front().point, other.vertices[v]);
  EXPECT_EQ(*std::max_element(found.facets_off_mm[1].begin(), found.facets_off_mm[1].end()), found.to_first.lower_mm);
}

// Two balls around one centre: the distance is that of their radii, but for how coarse the meshes are.
TEST(MeshDifference, DistancesOfConcentricBallsAreThoseOfTheirRadii) {
  const MeshDifference found = compare_meshes(ball(10, 1), ball(12, 1));
  for (const OneWayDistance* way : {&found.to_second, &found.to_first}) {
    EXPECT_NEAR(way->lower_mm, 2, 0.1);
    EXPECT_LE(way->lower_mm, *way->upper_mm);
    EXPECT_LE(*way->upper_mm, 1.26 * way->lower_mm);
  }
}

// With a limit the bounds are as close as it takes.
TEST(MeshDifference, ALimitIsProvedWhereItHolds) {
  const TetMesh coarse = ball(10, 3);
  const TetMesh fine = ball(10, 1);
  const MeshDifference rough = compare_meshes(coarse, fine);
  DistanceOptions options;
  options.limit_mm = 1.1 * std::max(rough.to_first.lower_mm, rough.to_second.lower_mm);
  const MeshDifference found = compare_meshes(coarse, fine, options);
  EXPECT_LE(*found.to_second.upper_mm, *options.limit_mm);
  EXPECT_LE(*found.to_first.upper_mm, *options.limit_mm);
}

TEST(MeshDifference, ThreadsDoNotMatter) {
  const TetMesh a = ball(10, 2);
  const TetMesh b = ball(10.5, 2);
  MeshDifference one;
  MeshDifference many;
  with_threads(1, [&] { one = compare_meshes(a, b); });
  with_threads(4, [&] { many = compare_meshes(a, b); });
  EXPECT_EQ(one.to_first, many.to_first);
  EXPECT_EQ(one.to_second, many.to_second);
  EXPECT_EQ(one.facets_off_mm, many.facets_off_mm);
}

}  // namespace
}  // namespace scantet
