// Sets, fields and nodes on edges are compared member by member, value by value and edge by edge, however the meshes
// are numbered.
#include "scantet/check/attached_difference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <random>

#include "scantet/base/mesh_topology.h"
#include "scantet/check/mesh_difference.h"
#include "scantet/domain/analytic.h"
#include "scantet/refine/mesher.h"

namespace scantet {
namespace {

constexpr std::size_t kEdges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};

// A ball of 10 mm with a node in the middle of each edge, a set of all kinds, and a field.
TetMesh ball() {
  Progress progress;
  const auto domain = make_sphere({1, 2, 3}, 10);
  TetMesh mesh = mesh_domain(*domain, UniformSize(4), {}, progress).mesh;
  std::map<std::array<VertexId, 2>, VertexId> nodes;
  for (const Tet& tet : mesh.tets) {
    std::array<VertexId, 6>& on_edges = mesh.tet_edge_vertices.emplace_back();
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [a, b] = std::minmax(tet[kEdges[e][0]], tet[kEdges[e][1]]);
      const auto [entry, is_new] = nodes.try_emplace({a, b}, static_cast<VertexId>(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back(lerp(mesh.vertices[a], mesh.vertices[b], 0.5));
      on_edges[e] = entry->second;
    }
  }
  mesh.sets = {{"foot", {0, 3, 5, static_cast<VertexId>(mesh.vertices.size() - 1)}, {1, 2, 8}, {4, 6}}};
  mesh.fields = {{"hu", {}}};
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.fields[0].values.push_back(static_cast<double>(t));
  return mesh;
}

// The same with vertices, tets and facets in another order, corners of tets turned, and facets beginning elsewhere.
TetMesh shuffled(const TetMesh& mesh) {
  std::mt19937 random(5);
  const auto order_of = [&](std::size_t count) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    std::shuffle(order.begin(), order.end(), random);
    return order;
  };
  const auto vertex = order_of(mesh.vertices.size());
  const auto tet = order_of(mesh.tets.size());
  const auto facet = order_of(mesh.boundary_facets.size());
  TetMesh other = mesh;
  for (std::size_t v = 0; v < vertex.size(); ++v) other.vertices[vertex[v]] = mesh.vertices[v];
  for (std::size_t t = 0; t < tet.size(); ++t) {
    const Tet& c = mesh.tets[t];
    const auto& e = mesh.tet_edge_vertices[t];
    other.tets[tet[t]] = {vertex[c[1]], vertex[c[2]], vertex[c[0]], vertex[c[3]]};
    other.tet_edge_vertices[tet[t]] = {vertex[e[1]], vertex[e[2]], vertex[e[0]],
                                       vertex[e[4]], vertex[e[5]], vertex[e[3]]};
    other.tet_regions[tet[t]] = mesh.tet_regions[t];
    other.fields[0].values[tet[t]] = mesh.fields[0].values[t];
  }
  for (std::size_t f = 0; f < facet.size(); ++f) {
    const Triangle& c = mesh.boundary_facets[f];
    other.boundary_facets[facet[f]] = {vertex[c[2]], vertex[c[0]], vertex[c[1]]};
  }
  for (VertexId& v : other.sets[0].vertices) v = vertex[v];
  for (std::uint32_t& f : other.sets[0].facets) f = facet[f];
  for (std::uint32_t& t : other.sets[0].tets) t = tet[t];
  return other;
}

// pairs as the tets at the same places give them.
AttachedDifference compare(const TetMesh& a, const TetMesh& b, double tolerance_mm = 0) {
  return compare_attached(a, b, compare_meshes(a, b).pairs, tolerance_mm);
}

void expect_nothing(const AttachedDifference& found) {
  EXPECT_TRUE(found.is_paired);
  EXPECT_TRUE(found.is_one_to_one);
  ASSERT_TRUE(found.edge_nodes.has_value());
  EXPECT_EQ(found.edge_nodes->largest_mm, 0);
  ASSERT_EQ(found.sets.size(), 3u);
  for (const SetDifference& set : found.sets) {
    ASSERT_TRUE(set.alone.has_value()) << set.of;
    EXPECT_TRUE(set.is_same()) << set.of;
  }
  ASSERT_EQ(found.fields.size(), 1u);
  EXPECT_EQ(found.fields[0].largest, 0);
}

TEST(AttachedDifference, NumberingDoesNotMatter) {
  const TetMesh mesh = ball();
  expect_nothing(compare(mesh, mesh));
  expect_nothing(compare(mesh, shuffled(mesh)));
}

TEST(AttachedDifference, AMemberThatIsExchangedIsFoundWithItsPlace) {
  const TetMesh mesh = ball();
  TetMesh other = mesh;
  other.sets[0] = {"foot", {0, 3, 6, mesh.sets[0].vertices[3]}, {1, 2, 9}, {4, 7}};
  for (const TetMesh& second : {other, shuffled(other)}) {
    const AttachedDifference found = compare(mesh, second);
    ASSERT_EQ(found.sets.size(), 3u);
    for (const SetDifference& set : found.sets) {
      EXPECT_FALSE(set.is_same());
      EXPECT_EQ(set.alone, (std::array<std::uint64_t, 2>{1, 1})) << set.of;
      EXPECT_EQ(set.members[0], set.members[1]) << set.of;
    }
    EXPECT_EQ(found.sets[0].of, "vertices");
    EXPECT_EQ(found.sets[0].place, mesh.vertices[5]);
  }
}

TEST(AttachedDifference, TheLargestDifferenceOfAFieldIsFound) {
  const TetMesh mesh = ball();
  TetMesh other = mesh;
  other.fields[0].values[7] += 2;
  other.fields[0].values[9] -= 40;
  const AttachedDifference found = compare(mesh, shuffled(other));
  ASSERT_EQ(found.fields.size(), 1u);
  EXPECT_EQ(found.fields[0].largest, 40);
  EXPECT_EQ(found.fields[0].values, (std::array<double, 2>{9, -31}));
  EXPECT_EQ(found.fields[0].scale, static_cast<double>(mesh.tets.size() - 1));
}

TEST(AttachedDifference, NoNumberIsEqualToNoNumberAlone) {
  TetMesh mesh = ball();
  mesh.fields[0].values[3] = std::numeric_limits<double>::quiet_NaN();
  TetMesh other = mesh;
  EXPECT_EQ(compare(mesh, other).fields[0].largest, 0);
  other.fields[0].values[3] = 3;
  EXPECT_TRUE(std::isinf(compare(mesh, other).fields[0].largest));
}

TEST(AttachedDifference, AMovedNodeOnAnEdgeIsFoundAndMeasured) {
  const TetMesh mesh = ball();
  TetMesh other = mesh;
  const VertexId node = mesh.tet_edge_vertices[2][4];
  other.vertices[node].y += 0.36;
  for (const TetMesh& second : {other, shuffled(other)}) {
    const AttachedDifference found = compare(mesh, second);
    ASSERT_TRUE(found.edge_nodes.has_value());
    EXPECT_NEAR(found.edge_nodes->largest_mm, 0.36, 1e-12);
    EXPECT_EQ(found.edge_nodes->places[0], mesh.vertices[node]);
    EXPECT_EQ(found.edge_nodes->places[1], other.vertices[node]);
    for (const SetDifference& set : found.sets) EXPECT_TRUE(set.is_same()) << "a moved node is the same node";
  }
}

TEST(AttachedDifference, AVertexThatIsDoubleInOneMeshIsNotOneToOne) {
  const TetMesh mesh = ball();
  TetMesh other = mesh;
  const VertexId v = other.tets[0][0];
  other.tets[0][0] = static_cast<VertexId>(other.vertices.size());
  other.vertices.push_back(other.vertices[v]);
  const MeshDifference straight = compare_meshes(mesh, other);
  EXPECT_EQ(straight.same, Sameness::numbering) << "places alone do not tell";
  EXPECT_FALSE(compare_attached(mesh, other, straight.pairs, 0).is_one_to_one);
}

TEST(AttachedDifference, MovedVerticesArePairedByNumberWithinTheTolerance) {
  const TetMesh mesh = ball();
  TetMesh other = mesh;
  for (Point& p : other.vertices) p.x += 0.125;
  other.sets[0].tets = {4};
  ASSERT_TRUE(compare_meshes(mesh, other).pairs.empty());
  const AttachedDifference near = compare(mesh, other, 0.25);
  EXPECT_TRUE(near.is_paired);
  EXPECT_NEAR(near.edge_nodes->largest_mm, 0.125, 1e-12);
  EXPECT_EQ(near.sets.back().alone, (std::array<std::uint64_t, 2>{1, 0}));
  EXPECT_EQ(near.fields[0].largest, 0);

  const AttachedDifference far = compare(mesh, other, 0.0625);
  EXPECT_FALSE(far.is_paired);
  EXPECT_FALSE(far.edge_nodes.has_value());
  EXPECT_TRUE(far.fields.empty());
  EXPECT_TRUE(far.sets.front().is_same()) << "as many vertices";
  EXPECT_FALSE(far.sets.front().alone.has_value());
  EXPECT_FALSE(far.sets.back().is_same()) << "fewer tets";
}

}  // namespace
}  // namespace scantet
