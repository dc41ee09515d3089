// Names of regions and patches in the files that have names.
#include <gtest/gtest.h>

#include "io_test_support.h"

namespace scantet {
namespace {

class MeshNames : public IoTest {
 protected:
  static TetMesh named() {
    TetMesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    mesh.tets = {{0, 1, 2, 3}, {1, 4, 2, 3}};
    mesh.tet_regions = {1, 2};
    build_boundary(mesh);
    mesh.region_names = {{1, "Left kidney"}, {2, "left_Kidney"}};
    for (MeshPatch& patch : mesh.patches) {
      if (patch.regions == std::array<Region, 2>{1, 2}) patch.name = "2nd \"wall\"";
    }
    return mesh;
  }
  std::string text_of(const std::string& name) const {
    write_mesh(named(), file(name));
    std::ifstream in(file(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST_F(MeshNames, ArePlainAndDistinctInGmshFiles) {
  const std::string text = text_of("a.msh");
  for (const char* name : {"\"Left_kidney\"", "\"left_Kidney_2\"", "\"n_2nd__wall_\"", "\"boundary_1_0\""}) {
    EXPECT_NE(text.find(name), std::string::npos) << name;
  }
}

TEST_F(MeshNames, ArePlainAndDistinctInAbaqusFiles) {
  const std::string text = text_of("a.inp");
  for (const char* name : {"ELSET=LEFT_KIDNEY\n", "NODES_LEFT_KIDNEY_2\n", "NAME=N_2ND__WALL_,"}) {
    EXPECT_NE(text.find(name), std::string::npos) << name;
  }
}

TEST_F(MeshNames, AreReadBack) {
  write_mesh(named(), file("a.vtu"));
  EXPECT_EQ(read_mesh(file("a.vtu")).region_names, named().region_names);
  for (const char* name : {"a.msh", "a.msh2"}) {
    write_mesh(named(), file(name));
    const std::map<Region, std::string> plain{{1, "Left_kidney"}, {2, "left_Kidney_2"}};
    EXPECT_EQ(read_mesh(file(name)).region_names, plain) << name;
  }
}

TEST_F(MeshNames, OfOtherProgramsMayHaveSpaces) {
  write_mesh(named(), file("a.msh"));
  std::string text = content_of(file("a.msh"));
  text.replace(text.find("\"Left_kidney\""), 13, "\"Left kidney\"");
  std::ofstream(file("b.msh")) << text;
  EXPECT_EQ(read_mesh(file("b.msh")).region_names.at(1), "Left kidney");
}

TEST_F(MeshNames, OfRegionsThatAreNotThereAreLeftOut) {
  TetMesh mesh = named();
  mesh.region_names = {{1, "one"}, {7, "seven"}};
  write_mesh(mesh, file("a.vtu"));
  EXPECT_EQ(read_mesh(file("a.vtu")).region_names, (std::map<Region, std::string>{{1, "one"}}));
}

TEST_F(MeshNames, FieldsAndSetsAreReadBackFromVtu) {
  TetMesh mesh = named();
  mesh.fields = {{"hu", {0.1, -3}}, {"a", {2, 4}}};
  mesh.sets = {{"foot", {0, 2}, {}, {}}, {"tip", {4}, {0}, {1}}, {"core", {}, {}, {0}}};
  write_mesh(mesh, file("a.vtu"));
  const TetMesh read = read_mesh(file("a.vtu"));
  ASSERT_EQ(read.fields.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.fields[i].name, mesh.fields[i].name);
    EXPECT_EQ(read.fields[i].values, mesh.fields[i].values);
  }
  ASSERT_EQ(read.sets.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(read.sets[i].name, mesh.sets[i].name);
    EXPECT_EQ(read.sets[i].vertices, mesh.sets[i].vertices);
    EXPECT_EQ(read.sets[i].tets, mesh.sets[i].tets);
    EXPECT_TRUE(read.sets[i].facets.empty());  // a .vtu holds tets only
  }
}

TEST_F(MeshNames, SecondOrderIsRefusedWithoutANodeForEachEdge) {
  TetMesh mesh = named();
  mesh.tet_edge_vertices.resize(mesh.tets.size() - 1);
  EXPECT_THROW(write_mesh(mesh, file("a.vtu")), Error);
  EXPECT_EQ(files_in_folder(), 0U);
}

}  // namespace
}  // namespace scantet
