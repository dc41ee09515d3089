#include "scantet/base/mesh_topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "boundary_flags.h"
#include "scantet/base/error.h"

namespace scantet {
namespace {

/// Two tets on either side of the triangle 1 2 3.
TetMesh two_tets(Region first, Region second) {
  TetMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  mesh.tets = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  mesh.tet_regions = {first, second};
  for (const Tet& t : mesh.tets) {
    EXPECT_GT(orientation_mm3(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]), 0);
  }
  return mesh;
}

Vec normal(const TetMesh& mesh, const Triangle& facet) {
  const Point& a = mesh.vertices[facet[0]];
  return cross(mesh.vertices[facet[1]] - a, mesh.vertices[facet[2]] - a);
}

/// Volume enclosed by the facets that separate `region` from the rest.
double enclosed_mm3(const TetMesh& mesh, Region region) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.boundary_facets.size(); ++i) {
    const double part = dot(mesh.vertices[mesh.boundary_facets[i][0]], normal(mesh, mesh.boundary_facets[i])) / 6;
    if (mesh.facet_regions[i][0] == region) sum += part;
    if (mesh.facet_regions[i][1] == region) sum -= part;
  }
  return sum;
}

TEST(FaceOf, PointsOutOfAPositiveTet) {
  const TetMesh mesh = two_tets(1, 1);
  const Tet& tet = mesh.tets[0];
  for (int face = 0; face < 4; ++face) {
    const Triangle triangle = face_of(tet, face);
    const VertexId opposite = tet[static_cast<std::size_t>(face)];
    EXPECT_EQ(std::count(triangle.begin(), triangle.end(), opposite), 0);
    EXPECT_LT(dot(normal(mesh, triangle), mesh.vertices[opposite] - mesh.vertices[triangle[0]]), 0);
  }
}

TEST(BuildBoundary, OneRegionHasNoInnerFacets) {
  TetMesh mesh = two_tets(3, 3);
  build_boundary(mesh);
  EXPECT_EQ(mesh.boundary_facets.size(), 6U);
  for (const auto& regions : mesh.facet_regions) EXPECT_EQ(regions, (std::array<Region, 2>{3, kOutside}));
  EXPECT_EQ(test::boundary_flags(mesh), (std::vector<std::uint8_t>{1, 1, 1, 1, 1}));
  EXPECT_NEAR(enclosed_mm3(mesh, 3), 1.0 / 6 + 1.0 / 3, 1e-12);
}

TEST(BuildBoundary, AnInterfaceIsListedOnceFromTheSmallerRegion) {
  for (const auto& [first, second] : {std::pair<Region, Region>{1, 2}, {2, 1}, {-5, 7}}) {
    TetMesh mesh = two_tets(first, second);
    build_boundary(mesh);
    EXPECT_EQ(mesh.boundary_facets.size(), 7U);
    const std::array<Region, 2> expected{std::min(first, second), std::max(first, second)};
    EXPECT_EQ(std::count(mesh.facet_regions.begin(), mesh.facet_regions.end(), expected), 1);
    EXPECT_NEAR(enclosed_mm3(mesh, first), 1.0 / 6, 1e-12);
    EXPECT_NEAR(enclosed_mm3(mesh, second), 1.0 / 3, 1e-12);
  }
}

TEST(BuildBoundary, InnerVerticesAreNotOnIt) {
  TetMesh mesh;  // a tet split at its centre
  mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {1, 1, 1}};
  const Tet whole{0, 1, 2, 3};
  for (int face = 0; face < 4; ++face) {
    const Triangle t = face_of(whole, face);
    mesh.tets.push_back({t[0], t[2], t[1], 4});
  }
  mesh.tet_regions.assign(4, 1);
  build_boundary(mesh);
  EXPECT_EQ(mesh.boundary_facets.size(), 4U);
  EXPECT_EQ(test::boundary_flags(mesh), (std::vector<std::uint8_t>{1, 1, 1, 1, 0}));
}

TEST(BuildBoundary, NegativeTetsStillHaveOutwardFacets) {
  TetMesh mesh = two_tets(1, 2);
  for (Tet& tet : mesh.tets) std::swap(tet[0], tet[1]);
  build_boundary(mesh);
  EXPECT_NEAR(enclosed_mm3(mesh, 1), 1.0 / 6, 1e-12);
  EXPECT_NEAR(enclosed_mm3(mesh, 2), 1.0 / 3, 1e-12);
}

TEST(BuildBoundary, DoesNotDependOnTheOrderOfTetsOrTheirVertices) {
  TetMesh mesh = two_tets(1, 2);
  build_boundary(mesh);
  TetMesh other = mesh;
  std::swap(other.tets[0], other.tets[1]);
  std::swap(other.tet_regions[0], other.tet_regions[1]);
  for (Tet& tet : other.tets) tet = {tet[2], tet[0], tet[1], tet[3]};
  build_boundary(other);
  EXPECT_EQ(other.boundary_facets, mesh.boundary_facets);
  EXPECT_EQ(other.facet_regions, mesh.facet_regions);
  for (const Triangle& t : mesh.boundary_facets) EXPECT_EQ(t[0], std::min({t[0], t[1], t[2]}));
}

TEST(BuildBoundary, AFaceOfThreeTetsIsListedOnce) {
  TetMesh mesh = two_tets(1, 1);
  mesh.tets.push_back({1, 2, 3, 0});
  mesh.tet_regions.push_back(1);
  build_boundary(mesh);
  const auto is_shared = [](Triangle t) {
    std::sort(t.begin(), t.end());
    return t == Triangle{1, 2, 3};
  };
  EXPECT_EQ(std::count_if(mesh.boundary_facets.begin(), mesh.boundary_facets.end(), is_shared), 1);
}

TEST(BuildBoundary, NoTetsNoBoundary) {
  TetMesh mesh;
  mesh.boundary_facets = {{0, 1, 2}};
  mesh.facet_regions = {{1, 0}};
  build_boundary(mesh);
  EXPECT_TRUE(mesh.boundary_facets.empty());
  EXPECT_TRUE(mesh.facet_regions.empty());
}

/// On arbitrary tets (not a mesh in space): the facets are those that a map of faces finds.
TEST(BuildBoundary, AgreesWithAMapOfFaces) {
  std::mt19937 random(11);
  TetMesh mesh;
  for (int v = 0; v < 40; ++v) {
    mesh.vertices.push_back({std::ldexp(random(), -32), std::ldexp(random(), -32), std::ldexp(random(), -32)});
  }
  std::map<Triangle, std::vector<Region>> faces;
  while (mesh.tets.size() < 3000) {
    const auto any = [&random] { return static_cast<VertexId>(random() % 40); };
    const Tet tet{any(), any(), any(), any()};
    if (std::map<VertexId, int>{{tet[0], 0}, {tet[1], 0}, {tet[2], 0}, {tet[3], 0}}.size() != 4) continue;
    mesh.tets.push_back(tet);
    mesh.tet_regions.push_back(static_cast<Region>(1 + random() % 3));
    for (int face = 0; face < 4; ++face) {
      Triangle t = face_of(tet, face);
      std::sort(t.begin(), t.end());
      faces[t].push_back(mesh.tet_regions.back());
    }
  }
  build_boundary(mesh);
  std::vector<Triangle> expected;
  for (const auto& [face, regions] : faces) {
    if (regions.size() != 2 || regions[0] != regions[1]) expected.push_back(face);
  }
  std::vector<Triangle> found = mesh.boundary_facets;
  for (Triangle& t : found) std::sort(t.begin(), t.end());
  EXPECT_EQ(found, expected);
  EXPECT_GT(expected.size(), 1000U);
}

TEST(FacesBehindFacets, AreTheFacesOfTheTetsBehind) {
  TetMesh mesh = two_tets(2, 1);
  build_boundary(mesh);
  std::reverse(mesh.boundary_facets.begin(), mesh.boundary_facets.end());
  std::reverse(mesh.facet_regions.begin(), mesh.facet_regions.end());
  const std::vector<TetFace> faces = faces_behind_facets(mesh);
  ASSERT_EQ(faces.size(), mesh.boundary_facets.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    EXPECT_EQ(mesh.tet_regions[faces[i].tet], mesh.facet_regions[i][0]);
    Triangle face = face_of(mesh.tets[faces[i].tet], faces[i].face);
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    EXPECT_EQ(face, mesh.boundary_facets[i]);
  }
}

TEST(FacesBehindFacets, AFacetWithoutATetIsAnError) {
  TetMesh mesh = two_tets(1, 1);
  build_boundary(mesh);
  mesh.facet_regions[0] = {9, 0};
  try {
    faces_behind_facets(mesh);
    FAIL() << "no Error was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), "mesh.facet");
  }
}

}  // namespace
}  // namespace scantet
