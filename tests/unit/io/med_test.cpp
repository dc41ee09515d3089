// MED files, read back by the HDF5 library as the format's layout says.
#include <gtest/gtest.h>

#include "hdf5_test_support.h"
#include "model_test_support.h"

namespace scantet {
namespace {

const std::string kStep = "/ENS_MAA/mesh/-0000000000000000001-0000000000000000001";

/// The first group of each family of a kind: nodes at corners are of a second one.
std::map<int, std::string> groups_of(const std::string& file, const std::string& kind) {
  std::map<int, std::string> groups;
  const std::string families = "/FAS/mesh/" + kind;
  for (const std::string& name : members_in(file, families)) {
    const int number = attribute_in(file, families + "/" + name, "NUM");
    const int count = attribute_in(file, families + "/" + name + "/GRO", "NBR");
    EXPECT_LE(count, kind == "NOEUD" ? 2 : 1);
    groups[number] = text_in(file, families + "/" + name + "/GRO/NOM");
    EXPECT_TRUE(name.starts_with("FAM_" + std::to_string(number))) << name;
    EXPECT_LE(name.size(), 64U);
  }
  return groups;
}

template <std::size_t N>
void take_cells(const std::string& file, const std::string& type, const std::array<std::size_t, N>& order,
                std::map<std::string, std::vector<std::array<VertexId, N>>>& by_group) {
  const std::map<int, std::string> groups = groups_of(file, "ELEME");
  const std::string place = kStep + "/MAI/" + type;
  const auto nodes = numbers_in<int>(file, place + "/NOD", H5T_NATIVE_INT);
  const auto families = numbers_in<int>(file, place + "/FAM", H5T_NATIVE_INT);
  const std::size_t count = families.size();
  EXPECT_EQ(attribute_in(file, place + "/NOD", "NBR"), static_cast<int>(count));
  ASSERT_EQ(nodes.size(), N * count);
  for (std::size_t i = 0; i < count; ++i) {
    std::array<VertexId, N> cell{};
    for (std::size_t k = 0; k < N; ++k) cell[k] = static_cast<VertexId>(nodes[order[k] * count + i] - 1);
    by_group[groups.at(families[i])].push_back(cell);
  }
}

ReadModel read_med(const std::string& file) {
  ReadModel model;
  EXPECT_EQ(attribute_in(file, "/INFOS_GENERALES", "MAJ"), 4);
  const auto at = numbers_in<double>(file, kStep + "/NOE/COO", H5T_NATIVE_DOUBLE);
  const std::size_t count = at.size() / 3;
  for (std::size_t v = 0; v < count; ++v) model.vertices.push_back({at[v], at[count + v], at[2 * count + v]});
  take_cells<4>(file, "TE4", {0, 2, 1, 3}, model.regions);  // MED turns tets the other way
  take_cells<3>(file, "TR3", {0, 1, 2}, model.surfaces);
  const std::map<int, std::string> groups = groups_of(file, "NOEUD");
  const auto families = numbers_in<int>(file, kStep + "/NOE/FAM", H5T_NATIVE_INT);
  for (std::size_t v = 0; v < families.size(); ++v) {
    if (families[v] != 0) model.node_sets[groups.at(families[v])].insert(static_cast<VertexId>(v));
  }
  return model;
}

using Med = IoTest;

TEST_F(Med, HoldsTheMeshByGroups) {
  for (const int labels : {1, 3, 116}) {
    SCOPED_TRACE(labels);
    const TetMesh mesh = make_labelled_cube(6, labels);
    const std::string path = file(std::to_string(labels) + ".med");
    write_mesh(mesh, path);
    const ReadModel expected = model_of(mesh);
    const ReadModel found = read_med(path);
    expect_same_model(found, expected, 0);
    EXPECT_EQ(found.node_sets.size(), 1U);
    EXPECT_EQ(found.node_sets.at("boundary"), vertices_of_surfaces(expected));
  }
}

// More than label maps have.
TEST_F(Med, ManyGroupsAreWhole) {
  const TetMesh mesh = make_labelled_cube(12, 1728);
  write_mesh(mesh, file("a.med"));
  const std::vector<std::string> families = members_in(file("a.med"), "/FAS/mesh/ELEME");
  ASSERT_EQ(families.size(), 1728 + mesh.patches.size() + mesh.curves.size());
  for (const std::string& family : families) {
    const std::string group = text_in(file("a.med"), "/FAS/mesh/ELEME/" + family + "/GRO/NOM");
    ASSERT_TRUE(family.ends_with(group)) << family << " " << group;
  }
}

TEST_F(Med, LongNamesStayApart) {
  TetMesh mesh = make_named_cube();
  const std::string long_name(100, 'n');
  mesh.region_names = {{1, long_name + "1"}, {2, long_name + "2"}};
  write_mesh(mesh, file("a.med"), {true, std::string(300, 'p'), "4.1"});
  TetMesh turned = mesh;
  for (Point& p : turned.vertices) p = {-p.x, -p.y, p.z};
  const std::map<std::string, std::string> names{{long_name + "1", std::string(78, 'n') + "_1"},
                                                 {long_name + "2", std::string(78, 'n') + "_2"},
                                                 {"wall <\"&> -- of it", "wall______--_of_it"}};
  expect_same_model(read_med(file("a.med")), model_of(turned, names), 0);
}

}  // namespace
}  // namespace scantet
