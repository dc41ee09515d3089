#include "scantet/check/facet_crossings.h"

#include <gtest/gtest.h>

#include "scantet/base/mesh_topology.h"
#include "scantet/domain/analytic.h"
#include "scantet/refine/mesher.h"

namespace scantet {
namespace {

TetMesh mesh_of(const std::vector<Point>& vertices, const std::vector<Tet>& tets) {
  TetMesh mesh;
  mesh.vertices = vertices;
  mesh.tets = tets;
  mesh.tet_regions.assign(tets.size(), 1);
  build_boundary(mesh);
  return mesh;
}

const std::vector<Point> kTet{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// The tet and another one of these four corners, of which some may be the tet's.
TetMesh with(const std::vector<Point>& more, const Tet& other) {
  std::vector<Point> vertices = kTet;
  vertices.insert(vertices.end(), more.begin(), more.end());
  return mesh_of(vertices, {{0, 1, 2, 3}, other});
}

TEST(FacetCrossings, OfTetsThatShareNothing) {
  const std::vector<Point> far{{2, 0, 0}, {3, 0, 0}, {2, 1, 0}, {2, 0, 1}};
  EXPECT_TRUE(crossing_facets(with(far, {4, 5, 6, 7})).empty());
  const std::vector<Point> through{{0.2, 0.2, 0.2}, {3, 0.2, 0.2}, {2, 1, 0.2}, {2, 0.2, 1}};
  EXPECT_GE(crossing_facets(with(through, {4, 5, 6, 7})).size(), 4U);
  const std::vector<Point> touching{{0.25, 0.25, 0.5}, {3, 0.2, 2}, {3, 1, 2}, {2, 0.2, 3}};  // on the slanted facet
  EXPECT_FALSE(crossing_facets(with(touching, {4, 5, 6, 7})).empty());
  const std::vector<Point> beside{{0.25, 0.25, 0.5 + 1e-15}, {3, 0.2, 2}, {3, 1, 2}, {2, 0.2, 3}};
  EXPECT_TRUE(crossing_facets(with(beside, {4, 5, 6, 7})).empty());
}

TEST(FacetCrossings, OfTetsThatShareAVertex) {
  EXPECT_TRUE(crossing_facets(with({{2, 0, 0.1}, {2, 1, 0.1}, {2, 0, 1}}, {1, 4, 5, 6})).empty());
  EXPECT_FALSE(crossing_facets(with({{-1, 0.1, 0.1}, {-1, 0.3, 0.1}, {-1, 0.1, 0.3}}, {1, 5, 4, 6})).empty());
}

TEST(FacetCrossings, OfTetsThatShareAnEdge) {
  EXPECT_TRUE(crossing_facets(with({{0.5, -1, 0.1}, {0.5, -1, -1}}, {0, 1, 5, 4})).empty());
  EXPECT_FALSE(crossing_facets(with({{0.4, 0.4, 0.1}, {0.5, 1, -1}}, {0, 1, 5, 4})).empty());
  const TetMesh folded = with({{0.3, 0.4, 0}, {0.3, 0.4, -1}}, {0, 1, 5, 4});  // a facet in the plane z = 0
  EXPECT_FALSE(crossing_facets(folded).empty());
}

TEST(FacetCrossings, AreNoneOfMeshesAsTheyAreMade) {
  const UniformSize size(0.8);
  Progress progress;
  const TetMesh mesh = mesh_domain(*make_torus({}, 4, 1.5), size, {}, progress).mesh;
  ASSERT_GT(mesh.boundary_facets.size(), 500U);
  EXPECT_TRUE(crossing_facets(mesh).empty());
  TetMesh moved = mesh;
  moved.vertices[mesh.boundary_facets[7][0]] = {0, 0, 0};  // from the ring to the hole in its middle
  const std::vector<std::uint32_t> crossing = crossing_facets(moved);
  EXPECT_FALSE(crossing.empty());
  EXPECT_TRUE(std::is_sorted(crossing.begin(), crossing.end()));
}

}  // namespace
}  // namespace scantet
