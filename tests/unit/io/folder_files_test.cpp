// Formats that are folders: they appear whole or not at all, and replace nothing but their own kind.
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLMultiBlockDataReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <sstream>

#include "model_test_support.h"
#include "scantet/io/file_set.h"
#include "scantet/io/mesh_io.h"
#include "scantet/io/writable.h"

namespace scantet {
namespace {

const char* const kFolders[] = {"a.elmer", "a.mesh-complete", "a.stls", "a.blocks"};

/// What to write to get this folder.
std::string mesh_of(const std::string& folder) {
  return folder == "a.blocks" ? "a.vtm" : folder;
}

using FolderFiles = IoTest;

TEST_F(FolderFiles, ReplaceTheirOwnKindAndRefuseToReplaceOthers) {
  for (const std::string folder : kFolders) {
    SCOPED_TRACE(folder);
    const std::string path = file(mesh_of(folder));
    write_mesh(make_cube(2, 1, 2), path);
    const std::vector<std::string> before = files_at(file(folder));
    write_mesh(make_cube(1), path);
    EXPECT_NE(files_at(file(folder)).size(), 0U);
    if (folder != "a.elmer") {
      EXPECT_LT(files_at(file(folder)).size(), before.size()) << "an old patch is left";
    }
    put_content(file(folder + "/mine.txt"), "precious");
    const std::string whole = content_of_mesh(path);
    const Error error = error_of([&] { write_mesh(make_cube(2), path); });
    EXPECT_EQ(error.code(), "output.cannot_write");
    EXPECT_NE(std::string(error.what()).find("mine.txt"), std::string::npos) << error.what();
    EXPECT_EQ(content_of_mesh(path), whole);
    EXPECT_EQ(error_of([&] { check_writable(mesh_files(path), {}); }).code(), "output.cannot_write");
    std::filesystem::remove_all(file(folder));
    put_content(file(folder), "a file");
    EXPECT_EQ(error_of([&] { write_mesh(make_cube(2), path); }).code(), "output.cannot_write");
    EXPECT_EQ(content_of(file(folder)), "a file");
    std::filesystem::remove(file(folder));
    std::filesystem::remove(path);
    EXPECT_EQ(files_in_folder(), 0U) << "something temporary was left";
  }
}

TEST_F(FolderFiles, AppearWithTheirSetAndAreListedFileByFile) {
  {
    FileSet dropped;
    MeshWriteOptions how;
    how.set = &dropped;
    write_mesh(make_cube(1), file("a.elmer"), how);
    write_mesh(make_cube(1), file("a.vtm"), how);
    EXPECT_FALSE(std::filesystem::exists(file("a.elmer")));
  }
  EXPECT_EQ(files_in_folder(), 0U);
  FileSet set;
  MeshWriteOptions how;
  how.set = &set;
  write_mesh(make_cube(1), file("a.elmer"), how);
  const std::vector<FileSet::Entry> entries = set.entries();
  ASSERT_EQ(entries.size(), 5U);
  EXPECT_EQ(entries.front().path, file("a.elmer/mesh.boundary"));
  EXPECT_EQ(entries.front().sha256.size(), 64U);
  set.commit();
  EXPECT_EQ(files_at(file("a.elmer")).size(), 5U);
}

TEST_F(FolderFiles, WhatAKilledRunLeftIsTakenAwayByTheNext) {
  write_mesh(make_cube(1), file("a.elmer"));
  // As the name of a.elmer's temporary folder, of a process that is gone.
  std::string stem;
  {
    FileSet set;
    MeshWriteOptions how;
    how.set = &set;
    write_mesh(make_cube(1), file("a.elmer"), how);
    stem = std::filesystem::path(set.parts().front().part_path).filename().string();
  }
  stem = stem.substr(0, stem.find('.', 9));
  std::filesystem::create_directories(file(stem + ".1.part/sub"));
  put_content(file(stem + ".1.part/sub/mesh.nodes"), "left");
  ASSERT_EQ(files_in_folder(), 2U);
  write_mesh(make_cube(1), file("a.elmer"));
  EXPECT_EQ(files_in_folder(), 1U);
}

TEST_F(FolderFiles, AnOutputWithinAnotherIsRefused) {
  std::filesystem::create_directory(file("a.elmer"));
  const Error error = error_of([&] { check_writable({file("a.elmer"), file("a.elmer/b.vtu")}, {}); });
  EXPECT_EQ(error.code(), "usage.same_file");
}

/// Elmer's files by their definition: no Debian package reads them.
struct ElmerMesh {
  ReadModel model;
  std::vector<std::array<int, 2>> parents;  ///< of each boundary element
  int tetrahedron = 0;
};

ElmerMesh read_elmer(const std::string& folder) {
  ElmerMesh mesh;
  std::map<int, std::string> names;
  std::istringstream name_lines(content_of(folder + "/mesh.names"));
  for (std::string line; std::getline(name_lines, line);) {
    std::istringstream words(line);
    std::string dollar, name, equals;
    int number = 0;
    if (words >> dollar >> name >> equals >> number && dollar == "$") names[number] = name;
  }
  std::istringstream header(content_of(folder + "/mesh.header"));
  std::size_t nodes = 0, tets = 0, triangles = 0;
  header >> nodes >> tets >> triangles;
  std::istringstream node_words(content_of(folder + "/mesh.nodes"));
  int id = 0, partition = 0;
  for (Point p; node_words >> id >> partition >> p.x >> p.y >> p.z;) mesh.model.vertices.push_back(p);
  EXPECT_EQ(mesh.model.vertices.size(), nodes);
  std::istringstream tet_lines(content_of(folder + "/mesh.elements"));
  std::size_t found = 0;
  for (std::string line; std::getline(tet_lines, line); ++found) {
    std::istringstream words(line);
    int body = 0;
    Tet tet{};
    words >> id >> body >> mesh.tetrahedron;
    for (VertexId& v : tet) {
      words >> v;
      --v;
    }
    mesh.model.regions[names[body]].push_back(tet);
  }
  EXPECT_EQ(found, tets);
  std::istringstream facet_lines(content_of(folder + "/mesh.boundary"));
  for (std::string line; std::getline(facet_lines, line);) {
    std::istringstream words(line);
    int boundary = 0, type = 0;
    std::array<int, 2> parents{};
    Triangle facet{};
    words >> id >> boundary >> parents[0] >> parents[1] >> type;
    for (VertexId& v : facet) {
      words >> v;
      --v;
    }
    mesh.parents.push_back(parents);
    mesh.model.surfaces[names[boundary]].push_back(facet);
  }
  EXPECT_EQ(mesh.parents.size(), triangles);
  return mesh;
}

TEST_F(FolderFiles, ElmerHasBodiesBoundariesParentsAndNames) {
  const TetMesh mesh = make_labelled_cube(4, 3);
  write_mesh(mesh, file("a.elmer"));
  const ElmerMesh read = read_elmer(file("a.elmer"));
  EXPECT_EQ(read.tetrahedron, 504);
  expect_same_model(read.model, model_of(mesh), 0);
  for (std::size_t f = 0; f < mesh.boundary_facets.size(); ++f) {
    for (std::size_t side = 0; side < 2; ++side) {
      const int parent = read.parents[f][side];
      const Region region = mesh.facet_regions[f][side];
      ASSERT_EQ(parent == 0, region == kOutside) << f;
      if (parent == 0) continue;
      const auto t = static_cast<std::size_t>(parent - 1);
      EXPECT_EQ(mesh.tet_regions[t], region);
      for (const VertexId v : mesh.boundary_facets[f]) {
        EXPECT_NE(std::find(mesh.tets[t].begin(), mesh.tets[t].end(), v), mesh.tets[t].end());
      }
    }
  }
}

template <typename Reader>
vtkSmartPointer<typename std::remove_pointer<decltype(std::declval<Reader>().GetOutput())>::type> read_vtk(
    const std::string& path) {
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

int number_in(vtkDataSetAttributes* data, const char* array, vtkIdType i) {
  vtkDataArray* const numbers = data->GetArray(array);
  return numbers == nullptr ? -1 : static_cast<int>(numbers->GetTuple1(i));
}

/// A cube whose top is a patch of its own, and bulges otherwise: flat patches are caps.
TetMesh make_capped_cube() {
  TetMesh mesh = make_cube(4);
  for (Point& p : mesh.vertices) {
    if (p.z < 109.9) p.x += 0.01 * (p.z - 110) * (p.z - 110);
  }
  mesh.patches = {{{1, 0}, {}}, {{1, 0}, "outlet"}};
  for (std::size_t f = 0; f < mesh.boundary_facets.size(); ++f) {
    const bool is_top = std::all_of(mesh.boundary_facets[f].begin(), mesh.boundary_facets[f].end(),
                                    [&](VertexId v) { return mesh.vertices[v].z > 109.9; });
    mesh.facet_patches[f] = is_top ? 1 : 0;
  }
  return mesh;
}

TEST_F(FolderFiles, SimVascularFindsNodesElementsAndFacesByNumber) {
  TetMesh mesh = make_capped_cube();
  mesh.sets.push_back({"spot", {}, {3, 5}, {}});
  const std::string folder = file("a.mesh-complete");
  write_mesh(mesh, folder);
  const auto volume = read_vtk<vtkXMLUnstructuredGridReader>(folder + "/mesh-complete.mesh.vtu");
  ASSERT_EQ(volume->GetNumberOfCells(), static_cast<vtkIdType>(mesh.tets.size()));
  EXPECT_EQ(number_in(volume->GetPointData(), "GlobalNodeID", 7), 8);
  EXPECT_EQ(number_in(volume->GetCellData(), "GlobalElementID", 7), 8);
  EXPECT_EQ(number_in(volume->GetCellData(), "ModelRegionID", 7), 1);
  EXPECT_TRUE(volume->GetPointData()->GetArray("GlobalNodeID")->GetDataType() == VTK_INT);
  const std::map<std::string, vtkIdType> expected{{"mesh-complete.exterior.vtp", 192},
                                                  {"walls_combined.vtp", 160},
                                                  {"mesh-surfaces/outlet.vtp", 32},
                                                  {"mesh-surfaces/boundary_1_0.vtp", 160},
                                                  {"mesh-surfaces/spot.vtp", 2}};
  EXPECT_EQ(files_at(folder).size(), expected.size() + 1);
  for (const auto& [name, cells] : expected) {
    SCOPED_TRACE(name);
    const auto surface = read_vtk<vtkXMLPolyDataReader>(folder + "/" + name);
    ASSERT_EQ(surface->GetNumberOfCells(), cells);
    for (vtkIdType c = 0; c < cells; ++c) {
      const auto t = static_cast<std::size_t>(number_in(surface->GetCellData(), "GlobalElementID", c) - 1);
      ASSERT_LT(t, mesh.tets.size());
      EXPECT_EQ(number_in(surface->GetCellData(), "ModelRegionID", c), 1);
      Vec p[3];
      for (vtkIdType k = 0; k < 3; ++k) {
        const vtkIdType point = surface->GetCell(c)->GetPointId(k);
        const auto v = static_cast<VertexId>(number_in(surface->GetPointData(), "GlobalNodeID", point) - 1);
        ASSERT_NE(std::find(mesh.tets[t].begin(), mesh.tets[t].end(), v), mesh.tets[t].end());
        double at[3];
        surface->GetPoint(point, at);
        EXPECT_EQ((Point{at[0], at[1], at[2]}), mesh.vertices[v]);
        p[k] = mesh.vertices[v];
      }
      const bool is_top = number_in(surface->GetCellData(), "ModelFaceID", c) == 2;
      EXPECT_EQ(is_top, p[0].z > 109.9 && p[1].z > 109.9 && p[2].z > 109.9);
      if (is_top) {
        EXPECT_GT(cross(p[1] - p[0], p[2] - p[0]).z, 0) << "the normal points inward";
      }
    }
  }
}

TEST_F(FolderFiles, BlocksAreRegionsBoundariesAndSets) {
  TetMesh mesh = make_cube(4, 1, 2);
  mesh.fields.push_back({"density", {}});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.fields[0].values.push_back(0.5 * static_cast<double>(t));
  mesh.sets.push_back({"tip", {1, 4}, {2}, {0, 7, 9}});
  write_mesh(mesh, file("a & b.vtm"));
  const auto read = read_vtk<vtkXMLMultiBlockDataReader>(file("a & b.vtm"));
  auto* const blocks = vtkMultiBlockDataSet::SafeDownCast(read);
  ASSERT_NE(blocks, nullptr);
  ASSERT_EQ(blocks->GetNumberOfBlocks(), 4U);
  std::map<std::string, vtkUnstructuredGrid*> grids;
  for (unsigned b = 0; b < 4; ++b) {
    auto* const block = vtkMultiBlockDataSet::SafeDownCast(blocks->GetBlock(b));
    ASSERT_NE(block, nullptr);
    const std::string title = blocks->GetMetaData(b)->Get(vtkCompositeDataSet::NAME());
    for (unsigned i = 0; i < block->GetNumberOfBlocks(); ++i) {
      grids[title + "/" + block->GetMetaData(i)->Get(vtkCompositeDataSet::NAME())] =
          vtkUnstructuredGrid::SafeDownCast(block->GetBlock(i));
    }
  }
  ASSERT_EQ(grids.size(), 8U + sets_of_curves(mesh));
  for (const auto& [name, grid] : grids) ASSERT_NE(grid, nullptr) << name;
  vtkIdType tets = 0;
  for (const char* name : {"regions/region_1", "regions/region_2"}) {
    vtkUnstructuredGrid* const grid = grids.at(name);
    for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c, ++tets) {
      const auto t = static_cast<std::size_t>(number_in(grid->GetCellData(), "GlobalElementID", c) - 1);
      EXPECT_EQ(grid->GetCellData()->GetArray("density")->GetTuple1(c), mesh.fields[0].values[t]);
      EXPECT_EQ(number_in(grid->GetCellData(), "region", c), mesh.tet_regions[t]);
      for (vtkIdType k = 0; k < 4; ++k) {
        const vtkIdType point = grid->GetCell(c)->GetPointId(k);
        EXPECT_EQ(number_in(grid->GetPointData(), "GlobalNodeID", point) - 1,
                  static_cast<int>(mesh.tets[t][static_cast<std::size_t>(k)]));
      }
    }
  }
  EXPECT_EQ(tets, static_cast<vtkIdType>(mesh.tets.size()));
  EXPECT_EQ(grids.at("boundaries/boundary_1_2")->GetNumberOfCells(), 32);
  EXPECT_EQ(grids.at("curves/curve_0_1_2")->GetNumberOfCells(), static_cast<vtkIdType>(mesh.curve_edges.size()));
  EXPECT_EQ(grids.at("curves/curve_0_1_2")->GetCellType(0), VTK_LINE);
  EXPECT_EQ(grids.at("sets/tip_nodes")->GetNumberOfCells(), 2);
  EXPECT_EQ(number_in(grids.at("sets/tip_nodes")->GetPointData(), "GlobalNodeID", 1), 5);
  EXPECT_EQ(grids.at("sets/tip_facets")->GetNumberOfCells(), 1);
  EXPECT_EQ(grids.at("sets/tip_elements")->GetNumberOfCells(), 3);
}

TEST_F(FolderFiles, AnStlAPatchHasEachFacetOnce) {
  TetMesh mesh = make_cube(3, 1, 2);
  mesh.sets.push_back({"spot", {}, {3, 5}, {}});
  write_mesh(mesh, file("a.stls"));
  std::size_t triangles = 0;
  for (const char* name : {"boundary_1_0", "boundary_1_2", "boundary_2_0"}) {
    triangles += (content_of(file(std::string("a.stls/") + name + ".stl")).size() - 84) / 50;
  }
  EXPECT_EQ(triangles, mesh.boundary_facets.size());
  EXPECT_EQ(content_of(file("a.stls/spot.stl")).size(), 84U + 2 * 50);
}

}  // namespace
}  // namespace scantet
