// Curves and corners in mesh files. tests/fem/formats_read_back.py reads them by other programs.
#include <gtest/gtest.h>

#include "hdf5_test_support.h"
#include "model_test_support.h"
#include "scantet/io/mesh_io.h"

namespace scantet {
namespace {

/// Two regions, whose wall ends at the outside along a ring, and a sharp edge of a name.
class CurveFiles : public IoTest {
 protected:
  void SetUp() override {
    IoTest::SetUp();
    mesh_ = make_cube(2, 1, 2);
    const Triangle& facet = mesh_.boundary_facets.front();
    mesh_.curves.push_back({{0, 1}, "the crest", true});
    mesh_.curve_edges.push_back({facet[0], facet[1]});
    mesh_.edge_curves.push_back(1);
    build_boundary(mesh_);
  }
  std::string text_of(const std::string& name) const {
    write_mesh(mesh_, file(name));
    return content_of(file(name));
  }
  static bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }

  TetMesh mesh_;
};

TEST_F(CurveFiles, HaveNamesNumbersAndCorners) {
  ASSERT_EQ(mesh_.curves.size(), 2U);
  ASSERT_GE(mesh_.corners.size(), 2U);
  const std::string edges = std::to_string(mesh_.curve_edges.size());
  const std::string corners = std::to_string(mesh_.corners.size());
  for (const char* name : {"a.msh", "a.msh2"}) {
    const std::string text = text_of(name);
    // Regions have the numbers 1 and 2, boundaries 3 to 5.
    EXPECT_TRUE(contains(text, "1 6 \"curve_0_1_2\"\n1 7 \"the_crest\"\n0 8 \"corners\"\n")) << name;
  }
  EXPECT_TRUE(contains(text_of("a.msh"), "$Entities\n" + corners + " 2 3 2\n"));
  const std::string medit = text_of("a.mesh");
  EXPECT_TRUE(contains(medit, "# edge reference 7: the_crest, of regions 0 1\n"));
  EXPECT_TRUE(contains(medit, "\nEdges\n" + edges + "\n"));
  EXPECT_TRUE(contains(medit, "\nRidges\n1\n" + edges + "\nCorners\n" + corners + "\n"));
  const std::string abaqus = text_of("a.inp");
  for (const char* name : {"*NSET, NSET=CURVE_0_1_2\n", "*NSET, NSET=THE_CREST\n", "*NSET, NSET=CORNERS\n"}) {
    EXPECT_TRUE(contains(abaqus, name)) << name;
  }
  const std::string febio = text_of("a.feb");
  EXPECT_TRUE(contains(febio, "<Edge name=\"the_crest\">\n\t\t\t<line2 id=\"1\">"));
  EXPECT_TRUE(contains(text_of("a.bdf"), ": the_crest, nodes\nSET1"));
}

TEST_F(CurveFiles, OfMedAreCellsOfAFamily) {
  write_mesh(mesh_, file("a.med"));
  const std::string cells = "/ENS_MAA/mesh/-0000000000000000001-0000000000000000001/MAI/SE2";
  const auto nodes = numbers_in<int>(file("a.med"), cells + "/NOD", H5T_NATIVE_INT);
  const auto families = numbers_in<int>(file("a.med"), cells + "/FAM", H5T_NATIVE_INT);
  const std::size_t count = mesh_.curve_edges.size();
  ASSERT_EQ(nodes.size(), 2 * count);
  for (std::size_t e = 0; e < count; ++e) {
    EXPECT_EQ(nodes[e], static_cast<int>(mesh_.curve_edges[e][0]) + 1);
    EXPECT_EQ(nodes[count + e], static_cast<int>(mesh_.curve_edges[e][1]) + 1);
    EXPECT_EQ(families[e], mesh_.edge_curves[e] == 0 ? -6 : -7);
  }
}

TEST_F(CurveFiles, HaveTheirNamesForThemselves) {
  mesh_.sets = {{"corners", {0}, {}, {}}, {"curve_0_1_2", {1}, {}, {}}};
  const std::string text = text_of("a.msh2");
  for (const char* name : {"\"set_corners_named\"", "\"corners\"", "\"set_curve_0_1_2_named\"", "\"curve_0_1_2\""}) {
    EXPECT_TRUE(contains(text, name)) << name;
  }
}

TEST_F(CurveFiles, OfNamesOfTheirOwnComeBackFromAbaqusAsNodes) {
  write_mesh(mesh_, file("a.inp"));
  const TetMesh read = read_mesh(file("a.inp"));
  ASSERT_EQ(read.sets.size(), 1U);
  EXPECT_EQ(read.sets[0].name, "THE_CREST");
  EXPECT_EQ(read.sets[0].vertices.size(), 2U);
  EXPECT_EQ(read.curves.size(), 1U);
}

TEST_F(CurveFiles, MustBeEdgesOfTets) {
  mesh_.curve_edges.push_back({0, static_cast<VertexId>(mesh_.vertices.size() - 1)});
  mesh_.edge_curves.push_back(0);
  EXPECT_EQ(error_of([&] { write_mesh(mesh_, file("a.msh")); }).code(), "mesh.inconsistent");
}

TEST_F(CurveFiles, HaveNoTraceOfCurvesWhereThereAreNone) {
  mesh_ = make_cube(2);
  EXPECT_FALSE(contains(text_of("a.mesh"), "Edges"));
  EXPECT_FALSE(contains(text_of("a.mesh"), "Corners"));
  EXPECT_TRUE(contains(text_of("a.msh"), "$Entities\n0 0 1 1\n"));
  EXPECT_FALSE(contains(text_of("a.xdmf"), "curve"));
}

}  // namespace
}  // namespace scantet
