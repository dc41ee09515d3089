// Names of regions and patches in the files that have names.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>

#include "io_test_support.h"
#include "scantet/io/taken_names_impl.h"

namespace scantet {
namespace {

TEST(TakenNames, AreNumberedByTheFirstFreeNumber) {
  TakenNames taken{"NALL"};
  const std::vector<std::string> given{"a", "A", "a_2", "a_4", "a", "nall", "a", "b_2", "b", "b"};
  const std::vector<std::string> expected{"a", "A_2", "a_2_2", "a_4", "a_3", "nall_2", "a_5", "b_2", "b", "b_3"};
  for (std::size_t n = 0; n < given.size(); ++n) EXPECT_EQ(taken.distinct(given[n]), expected[n]);
}

TEST(TakenNames, AreFreeBehindAPrefixToo) {
  TakenNames taken;
  EXPECT_EQ(taken.distinct("NODES_A"), "NODES_A");
  EXPECT_EQ(taken.distinct("A", "NODES_"), "A_2");
  EXPECT_EQ(taken.distinct("NODES_A_2"), "NODES_A_2_2");
  EXPECT_EQ(taken.distinct("A"), "A");
}

TEST(TakenNames, AHundredThousandOfOneName) {
  constexpr int kNames = 100'000;
  TakenNames taken;
  for (int n = 1; n <= kNames; ++n) EXPECT_EQ(taken.distinct("set"), n == 1 ? "set" : "set_" + std::to_string(n));
}

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

TEST_F(MeshNames, FieldsAndSetsAreReadBackFromGmshAndAbaqusFiles) {
  TetMesh mesh = named();
  mesh.fields = {{"hu", {0.1, -3}}, {"a", {2, 4}}};
  mesh.sets = {
      {"tip", {4}, {0, 2}, {1}}, {"core", {}, {}, {0}}, {"core_and_tip", {}, {}, {0, 1}}, {"foot", {0, 2}, {}, {}}};
  for (const std::string name : {"a.msh", "a.msh2", "a.inp"}) {
    SCOPED_TRACE(name);
    write_mesh(mesh, file(name));
    TetMesh read = read_mesh(file(name));
    const bool is_abaqus = name == "a.inp";
    ASSERT_EQ(read.fields.size(), is_abaqus ? 0U : 2U);
    for (std::size_t i = 0; i < read.fields.size(); ++i) {
      EXPECT_EQ(read.fields[i].name, mesh.fields[i].name);
      EXPECT_EQ(read.fields[i].values, mesh.fields[i].values);
    }
    const auto named_as = [&](std::string of) {
      if (is_abaqus) std::transform(of.begin(), of.end(), of.begin(), [](unsigned char c) { return std::toupper(c); });
      return std::find_if(read.sets.begin(), read.sets.end(), [&](const MeshSet& set) { return set.name == of; });
    };
    for (const MeshSet& set : mesh.sets) {
      const auto found = named_as(set.name);
      ASSERT_NE(found, read.sets.end()) << set.name;
      EXPECT_EQ(found->vertices, set.vertices) << set.name;
      EXPECT_EQ(found->facets, set.facets) << set.name;
      EXPECT_EQ(found->tets, set.tets) << set.name;
    }
    const auto wall = named_as("n_2nd__wall_");  // a patch of a name of its own comes back as a set of facets
    ASSERT_NE(wall, read.sets.end());
    ASSERT_EQ(wall->facets.size(), 1U);
    EXPECT_EQ(read.facet_regions[wall->facets[0]], (std::array<Region, 2>{1, 2}));
    EXPECT_EQ(read.sets.size(), mesh.sets.size() + 1);
  }
}

TEST_F(MeshNames, OfAbaqusFilesAreNoneOfTheSetsThatEachHas) {
  TetMesh mesh = named();
  mesh.region_names = {{1, "a-b"}, {2, "a.b"}};
  mesh.sets = {
      {"boundary", {0}, {}, {}}, {"nodes_a_b", {1}, {}, {}}, {"eall", {}, {}, {1}},           {"a_b", {2}, {}, {}},
      {"x.y", {3}, {}, {}},      {"x-y", {4}, {}, {}},       {"elements_eall_2", {0}, {}, {}}};
  write_mesh(mesh, file("a.inp"));
  std::set<std::string> names;
  std::istringstream lines(content_of(file("a.inp")));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find("SET=");
    if (!line.starts_with('*') || at == std::string::npos) continue;
    EXPECT_TRUE(names.insert(line.substr(at + 4)).second) << line;
  }
  for (const char* name :
       {"A_B", "A_B_2", "A_B_3", "NODES_A_B", "NODES_A_B_2", "BOUNDARY", "BOUNDARY_2", "X_Y", "X_Y_2"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
}

// Readers take region_2 for region 2, so another region that is called so must not have the name as it is.
TEST_F(MeshNames, OfOtherRegionsDoNotExchangeThem) {
  using Regions = std::vector<Region>;
  // With the regions in an Abaqus file, where names have the numbers above those that there are.
  const std::vector<std::pair<std::map<Region, std::string>, Regions>> cases{
      {{{1, "region_2"}, {2, "region_1"}}, {1, 2}},
      {{{1, "Region 2"}}, {3, 2}},
      {{{1, "region.2"}, {2, "region_2"}}, {3, 2}},
      {{{2, "region_m7"}}, {1, 2}}};
  for (const auto& [names, of_abaqus] : cases) {
    TetMesh mesh = named();
    mesh.region_names = names;
    for (const std::string file_name : {"a.msh", "a.msh2", "a.inp"}) {
      SCOPED_TRACE(names.begin()->second + ", " + file_name);
      write_mesh(mesh, file(file_name));
      const TetMesh read = read_mesh(file(file_name));
      EXPECT_EQ(read.tet_regions, file_name == "a.inp" ? of_abaqus : mesh.tet_regions);
      const std::size_t named_tet = names.begin()->first == 1 ? 0 : 1;
      const std::string name = read.region_names.at(read.tet_regions[named_tet]);
      EXPECT_TRUE(name.ends_with("_named") || name.ends_with("_NAMED")) << name;
    }
  }
  TetMesh mesh = named();
  mesh.region_names = {{1, "region_1"}, {2, "region_x"}};
  write_mesh(mesh, file("a.msh"));
  EXPECT_NE(content_of(file("a.msh")).find("\"region_1\"\n3 2 \"region_x\"\n"), std::string::npos);
}

TEST_F(MeshNames, OfSetsThatLookLikeTheMeshesOwnGroupsComeBackFromAbaqusAndGmshFiles) {
  TetMesh mesh = named();
  for (const char* name :
       {"corners", "Curve_0_1", "curve_1", "boundary_1_0", "boundary_7_8", "boundary_12", "region_7"}) {
    mesh.sets.push_back({name, {0, 2}, {1}, {0}});
  }
  for (const char* name : {"a.msh", "a.msh2", "a.inp"}) {
    SCOPED_TRACE(name);
    write_mesh(mesh, file(name));
    TetMesh read = read_mesh(file(name));
    write_mesh(read, file(name));
    read = read_mesh(file(name));
    EXPECT_EQ(read.tet_regions, mesh.tet_regions);
    EXPECT_EQ(read.sets.size(), mesh.sets.size() + 1) << "and the wall, which has a name of its own";
    for (const MeshSet& set : read.sets) {
      if (set.name.starts_with("n_2nd") || set.name.starts_with("N_2ND")) continue;
      EXPECT_EQ(set.vertices, mesh.sets[0].vertices) << set.name;
      EXPECT_EQ(set.facets, mesh.sets[0].facets) << set.name;
      EXPECT_EQ(set.tets, mesh.sets[0].tets) << set.name;
    }
  }
}

// Nothing says that regions imply them.
TEST_F(MeshNames, OfBoundariesInFilesOfOtherProgramsAreThoseOfSets) {
  put_content(file("a.msh"),
              "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n2 5 \"boundary_1\"\n2 6 \"boundary_1_0\"\n"
              "3 1 \"bone\"\n$EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
              "$Elements\n3\n1 4 2 1 1 1 2 3 4\n2 2 2 5 5 1 2 3\n3 2 2 6 6 1 2 4\n$EndElements\n");
  const TetMesh read = read_mesh(file("a.msh"));
  ASSERT_EQ(read.sets.size(), 2U);
  EXPECT_EQ(read.sets[0].name, "boundary_1");
  EXPECT_EQ(read.sets[1].name, "boundary_1_0");
  EXPECT_EQ(read.sets[1].facets.size(), 1U);
}

TEST_F(MeshNames, SecondOrderIsRefusedWithoutANodeForEachEdge) {
  TetMesh mesh = named();
  mesh.tet_edge_vertices.resize(mesh.tets.size() - 1);
  EXPECT_THROW(write_mesh(mesh, file("a.vtu")), Error);
  EXPECT_EQ(files_in_folder(), 0U);
}

}  // namespace
}  // namespace scantet
