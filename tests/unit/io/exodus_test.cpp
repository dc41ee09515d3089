// Exodus files, read back by the format's own library, and by VTK's reader.
#include <gtest/gtest.h>
#include <vtkCompositeDataSet.h>
#include <vtkExodusIIReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>
#include <vtk_exodusII.h>

#include "model_test_support.h"

namespace scantet {
namespace {

class ExodusReader {
 public:
  explicit ExodusReader(const std::string& path) {
    int own_reals = sizeof(double);
    int file_reals = 0;
    float version = 0;
    id_ = ex_open(path.c_str(), EX_READ, &own_reals, &file_reals, &version);
    EXPECT_GE(id_, 0);
    EXPECT_EQ(file_reals, 8);
    ex_set_max_name_length(id_, kNameLength);
    EXPECT_EQ(ex_get_init_ext(id_, &counts_), 0);
  }
  ~ExodusReader() { ex_close(id_); }
  ExodusReader(const ExodusReader&) = delete;
  ExodusReader& operator=(const ExodusReader&) = delete;

  const ex_init_params& counts() const { return counts_; }

  ReadModel model() const {
    ReadModel model;
    const auto nodes = static_cast<std::size_t>(counts_.num_nodes);
    std::array<std::vector<double>, 3> at;
    for (auto& column : at) column.resize(nodes);
    EXPECT_EQ(ex_get_coord(id_, at[0].data(), at[1].data(), at[2].data()), 0);
    for (std::size_t v = 0; v < nodes; ++v) model.vertices.push_back({at[0][v], at[1][v], at[2][v]});
    std::vector<Tet> elements;
    for (const int block : ids(EX_ELEM_BLOCK, counts_.num_elem_blk)) {
      ex_block is{};
      is.id = block;
      is.type = EX_ELEM_BLOCK;
      EXPECT_EQ(ex_get_block_param(id_, &is), 0);
      EXPECT_STREQ(is.topology, "TETRA4");
      std::vector<int> corners(static_cast<std::size_t>(4 * is.num_entry));
      EXPECT_EQ(ex_get_conn(id_, EX_ELEM_BLOCK, block, corners.data(), nullptr, nullptr), 0);
      for (std::size_t i = 0; i < corners.size(); i += 4) {
        elements.push_back({id(corners[i]), id(corners[i + 1]), id(corners[i + 2]), id(corners[i + 3])});
        model.regions[name(EX_ELEM_BLOCK, block)].push_back(elements.back());
      }
    }
    for (const int set : ids(EX_SIDE_SET, counts_.num_side_sets)) take_side_set(set, elements, model);
    for (const int set : ids(EX_NODE_SET, counts_.num_node_sets)) {
      for (const int node : entries(EX_NODE_SET, set, nullptr))
        model.node_sets[name(EX_NODE_SET, set)].insert(id(node));
    }
    return model;
  }

  /// The numbers of the elements, which stand block by block.
  std::vector<int> numbers() const {
    std::vector<int> numbers(static_cast<std::size_t>(counts_.num_elem));
    EXPECT_EQ(ex_get_id_map(id_, EX_ELEM_MAP, numbers.data()), 0);
    return numbers;
  }

 private:
  static constexpr int kNameLength = 255;

  static VertexId id(int number) { return static_cast<VertexId>(number - 1); }

  std::vector<int> ids(ex_entity_type type, std::int64_t count) const {
    std::vector<int> list(static_cast<std::size_t>(count));
    EXPECT_EQ(ex_get_ids(id_, type, list.data()), 0);
    return list;
  }
  std::string name(ex_entity_type type, int of) const {
    char text[kNameLength + 1] = "";
    EXPECT_EQ(ex_get_name(id_, type, of, text), 0);
    return text;
  }
  std::vector<int> entries(ex_entity_type type, int set, std::vector<int>* sides) const {
    std::int64_t count = 0;
    std::int64_t factors = 0;
    ex_set parameters{};
    parameters.id = set;
    parameters.type = type;
    EXPECT_EQ(ex_get_sets(id_, 1, &parameters), 0);
    count = parameters.num_entry;
    factors = parameters.num_distribution_factor;
    EXPECT_EQ(factors, 0);
    std::vector<int> list(static_cast<std::size_t>(count));
    if (sides != nullptr) sides->resize(list.size());
    EXPECT_EQ(ex_get_set(id_, type, set, list.data(), sides == nullptr ? nullptr : sides->data()), 0);
    return list;
  }

  void take_side_set(int set, const std::vector<Tet>& elements, ReadModel& model) const {
    // The manual's table of the nodes of a tetrahedron's sides, which point outwards.
    constexpr int kFaceNodes[4][3] = {{1, 2, 4}, {2, 3, 4}, {1, 4, 3}, {1, 3, 2}};
    std::vector<int> sides;
    const std::vector<int> of = entries(EX_SIDE_SET, set, &sides);
    for (std::size_t i = 0; i < of.size(); ++i) {
      const Tet& tet = elements.at(static_cast<std::size_t>(of[i] - 1));
      const auto& nodes = kFaceNodes[sides[i] - 1];
      const auto corner = [&](int k) { return tet[static_cast<std::size_t>(nodes[k] - 1)]; };
      model.surfaces[name(EX_SIDE_SET, set)].push_back({corner(0), corner(1), corner(2)});
    }
  }

  int id_ = -1;
  ex_init_params counts_{};
};

using Exodus = IoTest;

TEST_F(Exodus, HoldsTheMeshByBlocksAndSideSets) {
  for (const int labels : {1, 3, 116}) {
    SCOPED_TRACE(labels);
    const TetMesh mesh = make_labelled_cube(6, labels);
    const std::string path = file(std::to_string(labels) + ".exo");
    write_mesh(mesh, path);
    const ExodusReader reader(path);
    const ReadModel expected = model_of(mesh);
    const ReadModel found = reader.model();
    expect_same_model(found, expected, 0);
    EXPECT_EQ(found.node_sets.size(), static_cast<std::size_t>(labels) + 1 + sets_of_curves(mesh));
    EXPECT_EQ(found.node_sets.at("boundary"), vertices_of_surfaces(expected));
    EXPECT_EQ(found.node_sets.at("nodes_region_1"), vertices_of_region(expected, "region_1"));
    EXPECT_EQ(reader.counts().num_elem, static_cast<std::int64_t>(mesh.tets.size()));
  }
}

TEST_F(Exodus, ElementsKeepTheirNumbers) {
  TetMesh mesh = make_cube(2);
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) mesh.tet_regions[i] = i % 2 == 0 ? 2 : 1;
  build_boundary(mesh);
  write_mesh(mesh, file("a.e"));
  const ExodusReader reader(file("a.e"));
  const std::vector<int> numbers = reader.numbers();
  const ReadModel found = reader.model();
  expect_same_model(found, model_of(mesh), 0);
  ASSERT_EQ(numbers.size(), mesh.tets.size());
  const std::vector<Tet>& first_block = found.regions.at("region_1");
  for (std::size_t i = 0; i < first_block.size(); ++i) {
    EXPECT_EQ(first_block[i], mesh.tets[static_cast<std::size_t>(numbers[i] - 1)]);
  }
}

TEST_F(Exodus, LongNamesAreKept) {
  TetMesh mesh = make_named_cube();
  const std::string long_name(200, 'n');
  mesh.region_names[1] = long_name;
  write_mesh(mesh, file("a.e"), {true, std::string(300, 'p'), "4.1"});
  TetMesh turned = mesh;
  for (Point& p : turned.vertices) p = {-p.x, -p.y, p.z};
  const std::map<std::string, std::string> names{{"wall <\"&> -- of it", "wall______--_of_it"}};
  expect_same_model(ExodusReader(file("a.e")).model(), model_of(turned, names), 0);
}

TEST_F(Exodus, VtkReadsIt) {
  const TetMesh mesh = make_cube(4, 1, 2);
  write_mesh(mesh, file("a.exo"));
  vtkNew<vtkExodusIIReader> reader;
  reader->SetFileName(file("a.exo").c_str());
  reader->Update();
  EXPECT_EQ(reader->GetNumberOfElementBlockArrays(), 2);
  EXPECT_NE(std::string(reader->GetElementBlockArrayName(0)).find("region_1"), std::string::npos);
  EXPECT_EQ(reader->GetNumberOfSideSetArrays(), 3);
  auto* const blocks = vtkMultiBlockDataSet::SafeDownCast(reader->GetOutput()->GetBlock(0));
  ASSERT_NE(blocks, nullptr);
  for (unsigned block : {0U, 1U}) {
    auto* const grid = vtkUnstructuredGrid::SafeDownCast(blocks->GetBlock(block));
    ASSERT_NE(grid, nullptr);
    EXPECT_EQ(grid->GetNumberOfCells(), 192);
  }
}

}  // namespace
}  // namespace scantet
