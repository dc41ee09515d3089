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

TEST_F(MeshNames, SecondOrderIsRefusedWithoutANodeForEachEdge) {
  TetMesh mesh = named();
  mesh.tet_edge_vertices.resize(mesh.tets.size() - 1);
  EXPECT_THROW(write_mesh(mesh, file("a.vtu")), Error);
  EXPECT_EQ(files_in_folder(), 0U);
}

}  // namespace
}  // namespace scantet
