// Abaqus and CalculiX files of others: what the format allows beside what we write.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "io_test_support.h"
#include "scantet/io/mesh_io.h"

namespace scantet {
namespace {

class InpReader : public IoTest {
 protected:
  TetMesh read(const std::string& content) const {
    put_content(file("a.inp"), content);
    return read_mesh(file("a.inp"));
  }
};

const std::string kNodes = "*NODE\n1, 0., 0., 0.\n2, 1., 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n5, 1, 1, 1\n";

TEST_F(InpReader, KeywordsInAnyCaseWithBlanksCommentsAndContinuedLines) {
  const TetMesh mesh = read(
      "*Heading\n free text, which is no number\n** a comment\n * node , nset = \"All of them\" ,\n** amid a keyword\n"
      "  Unsorted\n\n 40 , -1.e0 , +0. , 0,\n  30, 0, 1E0, 0\r\n20, 1, 0, 0, 0.5, 0.5, 0.5\n10, 0, 0, 1\n"
      "*element, ELSET=bone, Type=c3d4\n7, 40,\n20,\n** amid an element\n30, 10\n*End Part\n");
  EXPECT_EQ(mesh.vertices, (std::vector<Point>{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}));
  EXPECT_EQ(mesh.tets, (std::vector<Tet>{{3, 1, 2, 0}}));
  EXPECT_EQ(mesh.tet_regions, (std::vector<Region>{1}));
  EXPECT_EQ(mesh.boundary_facets.size(), 4U);
}

TEST_F(InpReader, SetsNamedAsOursAreRegionsAndOthersGetTheNumbersAbove) {
  const TetMesh mesh = read(kNodes +
                            "*ELEMENT, TYPE=C3D4, ELSET=Marrow\n1, 1, 2, 3, 4\n*ELEMENT, TYPE=C3D4, ELSET=Region_5\n"
                            "2, 2, 3, 4, 5\n*ELEMENT, TYPE=C3D4, ELSET=Skin\n3, 1, 2, 3, 5\n"
                            "*ELEMENT, TYPE=C3D4, ELSET=marrow\n4, 1, 2, 4, 5\n");
  EXPECT_EQ(mesh.tet_regions, (std::vector<Region>{6, 5, 7, 6}));
  const TetMesh negative = read(kNodes + "*ELEMENT, TYPE=C3D4, ELSET=REGION_M3\n1, 1, 2, 3, 4\n");
  EXPECT_EQ(negative.tet_regions, (std::vector<Region>{-3}));
  const TetMesh none = read(kNodes + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n");
  EXPECT_EQ(none.tet_regions, (std::vector<Region>{1}));
}

TEST_F(InpReader, RegionsMayBeListedBeforeAndAfterTheElements) {
  const TetMesh mesh = read("*ELSET, ELSET=REGION_2\n2\n" + kNodes +
                            "*ELEMENT, TYPE=C3D4, ELSET=Volume1\n1, 1, 2, 3, 4\n2, 2, 3, 4, 5\n3, 1, 2, 3, 5\n"
                            "4, 1, 2, 4, 5\n*ELSET, ELSET=Region_4, GENERATE\n1, 1000000000000, 2\n"
                            "*ELSET, ELSET=Other\nREGION_2, Region_4\n");
  EXPECT_EQ(mesh.tet_regions, (std::vector<Region>{4, 2, 4, 5}));
}

TEST_F(InpReader, SurfacesAndLinesAreNoTets) {
  const TetMesh mesh = read(kNodes +
                            "*ELEMENT, TYPE=T3D2, ELSET=Line1\n1, 1, 2\n*ELEMENT, TYPE=CPS3, ELSET=Surface1\n"
                            "2, 1, 2, 3\n*ELEMENT, TYPE=C3D4, ELSET=Volume1\n3, 1, 2, 3, 4\n");
  EXPECT_EQ(mesh.tets, (std::vector<Tet>{{0, 1, 2, 3}}));
  EXPECT_EQ(mesh.vertices.size(), 4U);
}

TEST_F(InpReader, NodesAndTrianglesOfSectionsAreSetsOfTheNamesThere) {
  const std::string content =
      "*NODE, NSET=Nall\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n*NODE, NSET=Held\n5, 1, 1, 1\n"
      "*ELEMENT, TYPE=C3D4, ELSET=V1\n1, 1, 2, 3, 4\n2, 2, 3, 4, 5\n"
      "*ELEMENT, TYPE=S3, ELSET=Wall\n11, 1, 3, 2\n12, 1, 2,\n4\n*ELEMENT, TYPE=STRI65, ELSET=Wall\n"
      "13, 4, 3, 1, 1, 1, 1\n*ELEMENT, TYPE=CPS3\n14, 3, 4, 5\n*ELEMENT, TYPE=M3D3, ELSET=Inside\n15, 2, 3, 4\n"
      "*ELSET, ELSET=Listed\n14, 2\n*ELEMENT, TYPE=T3D2, ELSET=Wire\n16, 1, 2\n*NSET, NSET=N2, ELSET=V1\n";
  put_content(file("a.inp"), content);
  std::vector<std::string> left_out;
  const TetMesh mesh = read_mesh(file("a.inp"), left_out);
  ASSERT_EQ(mesh.sets.size(), 4U);
  std::map<std::string, MeshSet> sets;
  for (const MeshSet& set : mesh.sets) sets[set.name] = set;
  EXPECT_EQ(sets["NALL"].vertices, (std::vector<VertexId>{0, 1, 2, 3})) << "it has not all of the nodes";
  EXPECT_EQ(sets["HELD"].vertices, std::vector<VertexId>{4});
  EXPECT_EQ(sets["WALL"].facets.size(), 3U);
  for (const std::uint32_t facet : sets["WALL"].facets) {
    const Triangle& corners = mesh.boundary_facets[facet];
    EXPECT_NE(std::find(corners.begin(), corners.end(), 0U), corners.end());
  }
  EXPECT_EQ(sets["LISTED"].facets.size(), 1U);
  EXPECT_EQ(sets["LISTED"].tets, std::vector<std::uint32_t>{1});
  EXPECT_EQ(left_out, (std::vector<std::string>{"*ELEMENT 'WIRE'", "*NSET 'N2'",
                                                "triangles of the set 'INSIDE' that are no boundary"}));
  write_mesh(mesh, file("b.inp"));
  const TetMesh again = read_mesh(file("b.inp"));
  EXPECT_EQ(again.sets.size(), 4U);
}

TEST_F(InpReader, ASetOfAllNodesFollowsFromTheMesh) {
  const std::string nodes = "*NODE, NSET=NALL\n" + kNodes.substr(kNodes.find('\n') + 1);
  EXPECT_TRUE(read(nodes + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n2, 2, 3, 4, 5\n").sets.empty());
}

TEST_F(InpReader, ATriangleHasAllOfItsNodes) {
  const std::string tet = kNodes + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n";
  for (const char* lines : {"*ELEMENT, TYPE=S3\n2, 1, 2\n", "*ELEMENT, TYPE=S6\n2, 1, 2, 3\n",
                            "*ELEMENT, TYPE=S3, ELSET=A\n2, 1, 2, 77\n"}) {
    EXPECT_EQ(error_of([&] { read(tet + lines); }).code(), "input.bad_mesh") << lines;
  }
}

TEST_F(InpReader, ADeckAroundAMeshOfOursIsRead) {
  const TetMesh mesh = make_cube(2, 1, 3);
  write_mesh(mesh, file("mesh.inp"), {true, "scantet test", "4.1"});
  const TetMesh back =
      read(content_of(file("mesh.inp")) +
           "*MATERIAL, NAME=BONE\n*ELASTIC\n15000., 0.3\n*SOLID SECTION, ELSET=EALL, MATERIAL=BONE\n*BOUNDARY\n"
           "BOUNDARY, 1, 3\n*STEP\n*STATIC\n*DLOAD\nEALL, GRAV, 9810., 0., 0., -1.\n*END STEP");
  EXPECT_EQ(back.vertices, mesh.vertices) << "it says that it is RAS";
  EXPECT_EQ(back.tets, mesh.tets);
  EXPECT_EQ(back.tet_regions, mesh.tet_regions);
}

}  // namespace
}  // namespace scantet
