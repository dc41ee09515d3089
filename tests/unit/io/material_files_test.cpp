// Materials in mesh files: groups of each solver's own, regions told beside them.
#include <gtest/gtest.h>
#include <vtk_exodusII.h>

#include "model_test_support.h"
#include "scantet/io/file_names.h"
#include "scantet/io/mesh_io.h"

namespace scantet {
namespace {

/// Two regions of three materials; that of tet t is t % 3.
TetMesh make_mesh() {
  TetMesh mesh = make_cube(2, 1, 2);
  mesh.materials = {{"soft", 10, 0.4, 1e-9}, {"hard", 1000, 0.3, 0}, {"unknown", 0, 0, 0}};
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) mesh.tet_materials.push_back(t % 3);
  return mesh;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

using MaterialFiles = IoTest;

TEST_F(MaterialFiles, FebioHasADomainForEachRegionAndMaterial) {
  const TetMesh mesh = make_mesh();
  write_mesh(mesh, file("a.feb"));
  const std::string text = content_of(file("a.feb"));
  EXPECT_TRUE(contains(text,
                       "<material id=\"1\" name=\"soft\" type=\"isotropic elastic\"><density>1e-09</density><E>10</E>"
                       "<v>0.4</v></material>"))
      << text;
  EXPECT_TRUE(contains(text, "name=\"hard\" type=\"isotropic elastic\"><E>1000</E>"));
  EXPECT_FALSE(contains(text, "name=\"unknown\" type"));
  for (const char* region : {"region_1", "region_2"}) {
    for (const char* material : {"soft", "hard", "unknown"}) {
      const std::string part = std::string(region) + "_" + material;
      EXPECT_TRUE(contains(text, "<Elements type=\"tet4\" name=\"" + part + "\">"));
      EXPECT_TRUE(contains(text, "<SolidDomain name=\"" + part + "\" mat=\"" + material + "\"/>"));
    }
    EXPECT_TRUE(contains(text, std::string("<ElementSet name=\"") + region + "\">"));
  }
  EXPECT_TRUE(contains(text, "<ElementSet name=\"material_soft\">"));
  EXPECT_EQ(count(text, "<elem id="), mesh.tets.size());
}

TEST_F(MaterialFiles, FebioHasFieldsDomainByDomain) {
  TetMesh mesh = make_mesh();
  mesh.fields.push_back({"density", {}});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.fields[0].values.push_back(1000.5 + static_cast<double>(t));
  write_mesh(mesh, file("a.feb"));
  const std::string text = content_of(file("a.feb"));
  EXPECT_EQ(count(text, "<ElementData name=\"density\" elem_set=\"region_"), 6U);
  EXPECT_EQ(count(text, "<e lid="), mesh.tets.size());
  // The first tet of the second region and the first material is the first of its domain.
  std::size_t t = 0;
  while (mesh.tet_regions[t] != 2 || mesh.tet_materials[t] != 0) ++t;
  EXPECT_TRUE(contains(text, "elem_set=\"region_2_soft\" data_type=\"scalar\">\n\t\t\t<e lid=\"1\">" +
                                 std::to_string(1000 + t) + ".5</e>"));
  EXPECT_FALSE(contains(text, " type=\"scalar\"")) << "FEBio 4 takes it for the name of a generator";
}

TEST_F(MaterialFiles, NastranHasAPropertyForEachRegionAndMaterial) {
  const TetMesh mesh = make_mesh();
  write_mesh(mesh, file("a.bdf"));
  const std::string text = content_of(file("a.bdf"));
  const auto field = [](std::string value) { return value.append(16 - value.size(), ' '); };
  const std::string soft = "MAT1*   " + field("1") + field("10.") + field("") + field(".4") + "\n*       1.-9\n";
  const std::string hard = "MAT1*   " + field("2") + field("1.+3") + field("") + field(".3") + "\n*       \n";
  EXPECT_TRUE(contains(text, "$ material 1: soft\n" + soft)) << text.substr(0, 600);
  EXPECT_TRUE(contains(text, "$ material 2: hard\n" + hard)) << text.substr(0, 600);
  EXPECT_FALSE(contains(text, "$ material 3"));
  EXPECT_EQ(count(text, "PSOLID  "), 6U);
  EXPECT_TRUE(contains(text, ": region_2_hard\nPSOLID  "));
  EXPECT_TRUE(contains(text, ": region_2, tetrahedra\nSET1"));
  EXPECT_TRUE(contains(text, ": material_soft, tetrahedra\nSET1"));
}

TEST_F(MaterialFiles, ExodusHasABlockForEachRegionAndMaterialAndSetsOfBoth) {
  const TetMesh mesh = make_mesh();
  write_mesh(mesh, file("a.e"));
  int own_reals = sizeof(double);
  int file_reals = 0;
  float version = 0;
  const int id = ex_open(file("a.e").c_str(), EX_READ, &own_reals, &file_reals, &version);
  ASSERT_GE(id, 0);
  ex_init_params counts{};
  EXPECT_EQ(ex_get_init_ext(id, &counts), 0);
  EXPECT_EQ(counts.num_elem_blk, 6);
  EXPECT_EQ(counts.num_elem_sets, 5);
  std::vector<int> map(mesh.tets.size());
  ex_get_id_map(id, EX_ELEM_MAP, map.data());
  std::vector<int> blocks(6);
  ex_get_ids(id, EX_ELEM_BLOCK, blocks.data());
  std::size_t next = 0;
  std::set<std::string> names;
  for (const int number : blocks) {
    char name[64] = {};
    ex_get_name(id, EX_ELEM_BLOCK, number, name);
    names.insert(name);
    ex_block block{};
    block.id = number;
    block.type = EX_ELEM_BLOCK;
    ex_get_block_param(id, &block);
    for (std::int64_t i = 0; i < block.num_entry; ++i) {
      const auto t = static_cast<std::size_t>(map[next++] - 1);
      const std::string expected =
          "region_" + std::to_string(mesh.tet_regions[t]) + "_" + mesh.materials[mesh.tet_materials[t]].name;
      EXPECT_EQ(name, expected);
    }
  }
  EXPECT_EQ(next, mesh.tets.size());
  EXPECT_EQ(names.size(), 6U);
  ex_close(id);
}

TEST_F(MaterialFiles, ElmerHasABodyForEachAndGmshPhysicalGroups) {
  const TetMesh mesh = make_mesh();
  write_mesh(mesh, file("a.elmer"));
  EXPECT_EQ(count(content_of(file("a.elmer/mesh.names")), "$ region_"), 6U);
  const std::string sections = content_of(file("a.elmer/materials.sif"));
  EXPECT_TRUE(contains(sections,
                       "Material 1\n  Name = \"soft\"\n  Youngs Modulus = Real 10\n  Poisson Ratio = Real 0.4\n"
                       "  Density = Real 1e-09\nEnd\n"))
      << sections;
  EXPECT_TRUE(contains(sections, "Material 3\n  Name = \"unknown\"\nEnd\n"));
  EXPECT_EQ(count(sections, "Body "), 6U);
  EXPECT_TRUE(contains(sections, "  Name = \"region_1_hard\"\n  Equation = 1\n  Material = 2\nEnd\n"));
  write_mesh(mesh, file("a.msh"));
  EXPECT_TRUE(contains(content_of(file("a.msh")), "\"material_hard\""));
  EXPECT_EQ(read_mesh(file("a.msh")).tet_regions, mesh.tet_regions);
}

TEST_F(MaterialFiles, NamesOfAnInpThatDifferByPunctuationAloneStayApart) {
  TetMesh mesh = make_cube(2, 1, 2);
  mesh.region_names = {{1, "a-b"}, {2, "a.b"}};
  mesh.sets = {{"c-d", {0, 1}, {}, {}}, {"c_d", {2}, {}, {}}};
  mesh.materials = {{"e.f", 1, 0.3, 0}, {"e-f", 2, 0.3, 0}};
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) mesh.tet_materials.push_back(t % 2);
  const InpNames names = inp_names(mesh);
  EXPECT_EQ(names.sets, (std::vector<std::string>{"C_D", "C_D_2"}));
  EXPECT_EQ(names.materials, (std::vector<std::string>{"MATERIAL_E_F", "MATERIAL_E_F_2"}));
  write_mesh(mesh, file("a.inp"));
  const std::string text = content_of(file("a.inp"));
  for (const char* part :
       {"ELSET=A_B\n", "ELSET=A_B_2\n", "*NSET, NSET=NODES_A_B_2\n", "*ELSET, ELSET=EALL\nA_B\nA_B_2\n",
        "NSET=C_D\n1, 2\n", "NSET=C_D_2\n3\n", "*MATERIAL, NAME=MATERIAL_E_F_2\n"}) {
    EXPECT_TRUE(contains(text, part)) << part;
  }
  EXPECT_EQ(read_mesh(file("a.inp")).tet_regions, mesh.tet_regions);
}

}  // namespace
}  // namespace scantet
