// The edges of polyhedra that a mesh is to follow.
#include <gtest/gtest.h>

#include <cmath>

#include "contract/plugin_case.h"
#include "error_code.h"
#include "scantet/check/audit.h"
#include "scantet/refine/mesher.h"
#include "surface_files.h"
#include "temporary_file.h"

namespace scantet {
namespace {

std::unique_ptr<Domain> open_facets(const Facets& facets, const std::string& degrees) {
  const test::TemporaryFile file("sharp.off", facets.off());
  std::vector<std::pair<std::string, std::string>> options;
  if (!degrees.empty()) options.emplace_back("sharp-edges", degrees);
  return open_with_plugin(SCANTET_POLYHEDRON_PLUGIN, file.path(), options);
}

Facets fine_cube() {
  Facets facets;
  facets.add_fine_cube({0, 0, 0}, 1, 4);
  return facets;
}

/// A prism of 40 sides with its axis along z, of height 2.
Facets prism() {
  constexpr int kSides = 40;
  Facets facets;
  std::vector<int> bottom;
  std::vector<int> top;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * M_PI * i / kSides;
    for (const double z : {-1.0, 1.0}) facets.points.push_back({3 * std::cos(angle), 3 * std::sin(angle), z});
    const int next = (i + 1) % kSides;
    facets.polygons.push_back({2 * i, 2 * next, 2 * next + 1, 2 * i + 1});
    bottom.insert(bottom.begin(), 2 * i);
    top.push_back(2 * i + 1);
  }
  facets.polygons.push_back(bottom);
  facets.polygons.push_back(top);
  return facets;
}

TEST(SharpEdges, AreFollowedOnlyIfAsked) {
  const auto domain = open_facets(cube(1), "");
  EXPECT_TRUE(domain->curves().empty());
  EXPECT_TRUE(domain->corners().empty());
}

TEST(SharpEdges, ACubeHasTwelveAndEightCorners) {
  for (const Facets& facets : {cube(1), fine_cube()}) {
    const auto domain = open_facets(facets, "90");
    const auto curves = domain->curves();
    const std::vector<Corner> corners = domain->corners();
    ASSERT_EQ(curves.size(), 12U);
    ASSERT_EQ(corners.size(), 8U);
    for (const auto& curve : curves) {
      EXPECT_NEAR(curve->length_mm(), 2, 1e-12);
      EXPECT_EQ(curve->regions(), (std::vector<Region>{1, kOutside}));
      ASSERT_TRUE(curve->corners());
      EXPECT_EQ(corners[(*curve->corners())[0]].point, curve->at(0));
      EXPECT_EQ(corners[(*curve->corners())[1]].point, curve->at(curve->length_mm()));
      const Point middle = curve->at(1);
      EXPECT_EQ((std::abs(middle.x) == 1) + (std::abs(middle.y) == 1) + (std::abs(middle.z) == 1), 2);
    }
    for (const Corner& corner : corners) EXPECT_EQ(corner.regions, (std::vector<Region>{kOutside, 1}));
    EXPECT_TRUE(open_facets(facets, "91")->curves().empty());
  }
}

TEST(SharpEdges, ARoundRimIsOneClosedCurve) {
  const auto domain = open_facets(prism(), "30");
  EXPECT_TRUE(domain->corners().empty());
  ASSERT_EQ(domain->curves().size(), 2U);
  for (const auto& curve : domain->curves()) {
    EXPECT_FALSE(curve->corners());
    EXPECT_NEAR(curve->length_mm(), 40 * 6 * std::sin(M_PI / 40), 1e-5);
  }
}

TEST(SharpEdges, AChainTurnsInACornerIfItTurnsAsMuch) {
  const auto domain = open_facets(prism(), "8");
  EXPECT_EQ(domain->corners().size(), 80U);
  EXPECT_EQ(domain->curves().size(), 120U);
}

TEST(SharpEdges, WhatIsRoundHasNone) {
  const auto domain = open_facets(ring(), "30");
  EXPECT_TRUE(domain->curves().empty());
  EXPECT_TRUE(domain->corners().empty());
}

TEST(SharpEdges, SeveralShellsHaveTheirOwn) {
  const auto domain = open_facets(cubes(), "60");
  EXPECT_EQ(domain->curves().size(), 36U);
  EXPECT_EQ(domain->corners().size(), 24U);
}

TEST(SharpEdges, TheMeshHasThem) {
  const auto domain = open_facets(fine_cube(), "60");
  Progress progress;
  const MeshResult result = mesh_domain(*domain, UniformSize(0.4), {}, progress);
  AuditOptions options;
  options.restricted_delaunay = false;  // regions are those of orthocentres, which a mesh does not know
  const AuditReport report = audit(result.mesh, domain.get(), options);
  for (const Finding& finding : report.findings) ADD_FAILURE() << finding.message;
  double volume_mm3 = 0;
  for (const Tet& t : result.mesh.tets) {
    const auto at = [&](std::size_t i) { return result.mesh.vertices[t[i]]; };
    volume_mm3 += dot(cross(at(1) - at(0), at(2) - at(0)), at(3) - at(0)) / 6;
  }
  EXPECT_NEAR(std::abs(volume_mm3), 8, 1e-9) << "nothing is cut off the cube";
}

TEST(SharpEdges, AnglesAreFromOneDegreeTo180) {
  for (const char* degrees : {"0", "-30", "181"}) {
    EXPECT_EQ(test::error_code([&] { open_facets(cube(1), degrees); }), "usage.value") << degrees;
  }
}

/// Opens the surface with the lines of a file whose name ends so.
std::unique_ptr<Domain> open_with_lines(const Facets& facets, const std::string& end, const std::string& lines) {
  const test::TemporaryFile file("lines" + end, lines);
  return open_facets(facets, file.path());
}

TEST(SharpEdges, AreThoseAlongTheLinesOfAFile) {
  // A square around the top of a cube whose edges are of four pieces, closed; and an upright edge that ends on it.
  const std::string square = "5  -1 -1 1  1 -1 1  1 1 1  -1 1 1  -1 -1 1\n";
  const auto domain = open_with_lines(fine_cube(), ".polylines.txt", "# rim\n\n" + square + "2 1 1 -1 1 1 1\n");
  EXPECT_EQ(domain->curves().size(), 5U);
  EXPECT_EQ(domain->corners().size(), 5U) << "where the square turns, and the lower end";
  double length = 0;
  for (const auto& curve : domain->curves()) length += curve->length_mm();
  EXPECT_NEAR(length, 10, 1e-12);
  const auto of_obj = open_with_lines(
      fine_cube(), ".obj",
      "o edges\nv -1 -1 1\nv 1 -1 1\nv 1.0000001 1 1\nv -1 1 1\nl 1 2 3 4 1\nv 1 1 -1\nl -1 3/1\nf 1 2 3\n");
  ASSERT_EQ(of_obj->curves().size(), 5U);
  for (std::size_t n = 0; n < 5; ++n) {
    EXPECT_EQ(of_obj->curves()[n]->at(0.7), domain->curves()[n]->at(0.7)) << "on the surface's edges";
  }
  EXPECT_EQ(open_with_lines(fine_cube(), ".txt", "2 -0.5 -1 1 0.5 -1 1\n")->corners().size(), 2U) << "part of an edge";
}

TEST(SharpEdges, LinesThatRunElsewhereAreRefused) {
  const auto said = [](const std::string& end, const std::string& lines) -> std::string {
    try {
      open_with_lines(fine_cube(), end, lines);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), "input.edges") << error.what();
      return error.what();
    }
    return "nothing";
  };
  EXPECT_NE(said(".txt", "\n2 -1 -1 1 1 1 1.25\n").find(".txt:2: the surface has no vertex at (1, 1, 1.25)"),
            std::string::npos);
  EXPECT_NE(said(".txt", "2 -1 -1 1 0.5 1 1\n").find("does not run along edges"), std::string::npos);
  EXPECT_NE(said(".txt", "3 -1 -1 1 1 -1 1\n").find("3 points have 9 coordinates"), std::string::npos);
  EXPECT_NE(said(".txt", "1 -1 -1 1\n").find("fewer than two"), std::string::npos);
  EXPECT_NE(said(".txt", "").find("no lines"), std::string::npos);
  EXPECT_NE(said(".txt", "2 0 0 0 0 0 nan\n").find("not finite"), std::string::npos);
  EXPECT_NE(said(".txt", "two\n").find("'two' is no number"), std::string::npos);
  EXPECT_NE(said(".obj", "v -1 -1 1\nl 1 2\n").find("no vertex 2"), std::string::npos);
  EXPECT_NE(said(".obj", "v -1 -1\nl 1 1\n").find("three coordinates"), std::string::npos);
  EXPECT_EQ(test::error_code([] { open_facets(cube(1), "no such file"); }), "input.edges");
}

}  // namespace
}  // namespace scantet
