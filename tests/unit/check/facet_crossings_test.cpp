#include "scantet/check/facet_crossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>

#include "scantet/base/mesh_topology.h"
#include "scantet/domain/analytic.h"
#include "scantet/quality/orientation.h"
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

struct PlacesLess {
  bool operator()(const std::array<Point, 3>& a, const std::array<Point, 3>& b) const {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), lexicographically_less);
  }
};

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

/// The crossing facets, each by its sorted corners.
std::set<std::array<Point, 3>, PlacesLess> corners_of_crossing(const TetMesh& mesh) {
  std::set<std::array<Point, 3>, PlacesLess> all;
  for (const std::uint32_t f : crossing_facets(mesh)) {
    std::array<Point, 3> corners;
    for (std::size_t n = 0; n < 3; ++n) corners[n] = mesh.vertices[mesh.boundary_facets[f][n]];
    std::sort(corners.begin(), corners.end(), lexicographically_less);
    all.insert(corners);
  }
  return all;
}

TEST(FacetCrossings, OfManyTetsAreThoseOfEachTwo) {
  constexpr int kTets = 60;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> in_cube(0, 4);
  std::uniform_real_distribution<double> beside(-1, 1);
  std::vector<std::vector<Point>> corners;
  for (int t = 0; t < kTets; ++t) {
    const Point from{in_cube(random), in_cube(random), in_cube(random)};
    std::vector<Point> four{from};
    while (four.size() < 4) four.push_back(from + Vec{beside(random), beside(random), beside(random)});
    if (orientation_sign(four[0], four[1], four[2], four[3]) < 0) std::swap(four[2], four[3]);
    corners.push_back(four);
  }
  std::vector<Point> vertices;
  std::vector<Tet> tets;
  for (const auto& four : corners) {
    const auto v = static_cast<VertexId>(vertices.size());
    tets.push_back({v, v + 1, v + 2, v + 3});
    vertices.insert(vertices.end(), four.begin(), four.end());
  }
  std::set<std::array<Point, 3>, PlacesLess> of_pairs;
  for (std::size_t a = 0; a < corners.size(); ++a) {
    for (std::size_t b = a + 1; b < corners.size(); ++b) {
      std::vector<Point> eight = corners[a];
      eight.insert(eight.end(), corners[b].begin(), corners[b].end());
      of_pairs.merge(corners_of_crossing(mesh_of(eight, {{0, 1, 2, 3}, {4, 5, 6, 7}})));
    }
  }
  EXPECT_GT(of_pairs.size(), 50U);
  EXPECT_LT(of_pairs.size(), 4U * kTets);
  EXPECT_EQ(corners_of_crossing(mesh_of(vertices, tets)), of_pairs);
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
