// XDMF files: the description read back by VTK's XML parser, the arrays by the HDF5 library.
#include <gtest/gtest.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <sstream>

#include "hdf5_test_support.h"
#include "model_test_support.h"

namespace scantet {
namespace {

class Xdmf : public IoTest {
 protected:
  /// What an item refers to, whose dimensions must be those of the array.
  template <typename Number>
  std::vector<Number> values_of(vtkXMLDataElement* parent, hid_t type) const {
    vtkXMLDataElement* const item = parent->FindNestedElementWithName("DataItem");
    EXPECT_STREQ(item->GetAttribute("Format"), "HDF");
    const std::string reference = item->GetCharacterData();
    const std::size_t colon = reference.find(':');
    std::vector<hsize_t> extents;
    const auto values =
        numbers_in<Number>(file(reference.substr(0, colon)), reference.substr(colon + 1), type, &extents);
    std::string dimensions;
    for (const hsize_t extent : extents) dimensions += (dimensions.empty() ? "" : " ") + std::to_string(extent);
    EXPECT_EQ(item->GetAttribute("Dimensions"), dimensions);
    return values;
  }

  template <std::size_t N>
  void take_grid(vtkXMLDataElement* grid, std::map<std::string, std::vector<std::array<VertexId, N>>>& groups) const {
    std::map<std::string, std::string> names;
    vtkXMLDataElement* attribute = nullptr;
    for (int i = 0; i < grid->GetNumberOfNestedElements(); ++i) {
      vtkXMLDataElement* const part = grid->GetNestedElement(i);
      if (std::string(part->GetName()) == "Information")
        names[part->GetAttribute("Value")] = part->GetAttribute("Name");
      if (std::string(part->GetName()) == "Attribute") attribute = part;
    }
    ASSERT_NE(attribute, nullptr);
    EXPECT_STREQ(attribute->GetAttribute("Center"), "Cell");
    const auto tags = values_of<int>(attribute, H5T_NATIVE_INT);
    vtkXMLDataElement* const topology = grid->FindNestedElementWithName("Topology");
    EXPECT_STREQ(topology->GetAttribute("TopologyType"), N == 4 ? "Tetrahedron" : "Triangle");
    EXPECT_EQ(topology->GetAttribute("NumberOfElements"), std::to_string(tags.size()));
    const auto corners = values_of<std::int64_t>(topology, H5T_NATIVE_INT64);
    ASSERT_EQ(corners.size(), N * tags.size());
    for (std::size_t i = 0; i < tags.size(); ++i) {
      std::array<VertexId, N> element{};
      for (std::size_t k = 0; k < N; ++k) element[k] = static_cast<VertexId>(corners[N * i + k]);
      groups[names.at(std::to_string(tags[i]))].push_back(element);
    }
  }

  ReadModel read(const std::string& path) const {
    ReadModel model;
    const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(path.c_str()));
    if (root == nullptr) {
      ADD_FAILURE() << "no XML";
      return model;
    }
    EXPECT_STREQ(root->GetName(), "Xdmf");
    vtkXMLDataElement* const domain = root->FindNestedElementWithName("Domain");
    vtkXMLDataElement* const mesh = domain->FindNestedElementWithNameAndAttribute("Grid", "Name", "mesh");
    const auto at = values_of<double>(mesh->FindNestedElementWithName("Geometry"), H5T_NATIVE_DOUBLE);
    for (std::size_t v = 0; v < at.size(); v += 3) model.vertices.push_back({at[v], at[v + 1], at[v + 2]});
    take_grid(mesh, model.regions);
    take_grid(domain->FindNestedElementWithNameAndAttribute("Grid", "Name", "boundary"), model.surfaces);
    return model;
  }
};

TEST_F(Xdmf, HoldsTheMeshByTags) {
  for (const int labels : {1, 3, 116}) {
    SCOPED_TRACE(labels);
    const TetMesh mesh = make_labelled_cube(6, labels);
    const std::string path = file(std::to_string(labels) + ".xdmf");
    write_mesh(mesh, path);
    expect_same_model(read(path), model_of(mesh), 0);
  }
}

TEST_F(Xdmf, NamesOfFilesAndGroupsStandInXml) {
  const TetMesh mesh = make_named_cube();
  write_mesh(mesh, file("a & <b>.v1.XDMF"), {true, "scantet", "4.1"});
  TetMesh turned = mesh;
  for (Point& p : turned.vertices) p = {-p.x, -p.y, p.z};
  const std::map<std::string, std::string> names{
      {"Left kidney", "Left_kidney"}, {"left_Kidney", "left_Kidney_2"}, {"wall <\"&> -- of it", "wall______--_of_it"}};
  expect_same_model(read(file("a & <b>.v1.XDMF")), model_of(turned, names), 0);
  EXPECT_TRUE(std::filesystem::exists(file("a & <b>.v1.h5"))) << "FEniCSx looks for this name";
}

TEST_F(Xdmf, HasNoTimeStamps) {
  const TetMesh mesh = make_cube(3, 1, 2);
  write_mesh(mesh, file("a.xdmf"));
  const std::string before = content_of(file("a.h5"));
  sleep(2);  // HDF5 counts whole seconds
  write_mesh(mesh, file("a.xdmf"));
  EXPECT_EQ(content_of(file("a.h5")), before);
}

TEST_F(Xdmf, FilesOfBothAreListed) {
  EXPECT_EQ(mesh_files("x/a.xdmf"), (std::vector<std::string>{"x/a.xdmf", "x/a.h5"}));
  EXPECT_EQ(mesh_files("x/a.vtu"), (std::vector<std::string>{"x/a.vtu"}));
}

}  // namespace
}  // namespace scantet
