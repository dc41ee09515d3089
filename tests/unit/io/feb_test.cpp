// FEBio files, read back by VTK's XML parser.
#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>
#include <vtkXMLUtilities.h>

#include <sstream>

#include "model_test_support.h"

namespace scantet {
namespace {

/// Numbers with commas between.
std::vector<double> numbers_of(vtkXMLDataElement* element) {
  std::string text = element->GetCharacterData();
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream words(text);
  std::vector<double> numbers;
  for (double number = 0; words >> number;) numbers.push_back(number);
  return numbers;
}

template <std::size_t N>
std::array<VertexId, N> vertices_in(vtkXMLDataElement* element) {
  const std::vector<double> numbers = numbers_of(element);
  EXPECT_EQ(numbers.size(), N);
  std::array<VertexId, N> vertices{};
  for (std::size_t i = 0; i < N && i < numbers.size(); ++i) vertices[i] = static_cast<VertexId>(numbers[i]) - 1;
  return vertices;
}

class FebReader {
 public:
  /// The model in the file.
  ReadModel read(const std::string& path) {
    ReadModel model;
    const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(path.c_str()));
    if (root == nullptr) {
      ADD_FAILURE() << "no XML";
      return model;
    }
    EXPECT_STREQ(root->GetName(), "febio_spec");
    EXPECT_STREQ(root->GetAttribute("version"), "4.0");
    EXPECT_STREQ(root->GetNestedElement(0)->GetName(), "Module") << "FEBio wants it first";
    vtkXMLDataElement* const mesh = root->FindNestedElementWithName("Mesh");
    for (int i = 0; i < mesh->GetNumberOfNestedElements(); ++i) take(mesh->GetNestedElement(i), model);
    vtkXMLDataElement* const domains = root->FindNestedElementWithName("MeshDomains");
    for (int i = 0; i < domains->GetNumberOfNestedElements(); ++i) {
      vtkXMLDataElement* const domain = domains->GetNestedElement(i);
      EXPECT_STREQ(domain->GetName(), "SolidDomain");
      domains_[domain->GetAttribute("name")] = domain->GetAttribute("mat");
    }
    return model;
  }

  /// The material of each domain in the file that was read.
  const std::map<std::string, std::string>& domains() const { return domains_; }
  std::size_t edges() const { return edges_; }

 private:
  void take(vtkXMLDataElement* section, ReadModel& model) {
    const std::string kind = section->GetName();
    const std::string name = section->GetAttribute("name");
    if (kind == "NodeSet") {
      for (const double number : numbers_of(section)) model.node_sets[name].insert(static_cast<VertexId>(number) - 1);
    }
    for (int i = 0; i < section->GetNumberOfNestedElements(); ++i) {
      vtkXMLDataElement* const item = section->GetNestedElement(i);
      if (kind == "Nodes") {
        EXPECT_EQ(item->GetAttribute("id"), std::to_string(i + 1));
        const std::vector<double> at = numbers_of(item);
        model.vertices.push_back({at.at(0), at.at(1), at.at(2)});
      } else if (kind == "Elements") {
        EXPECT_STREQ(section->GetAttribute("type"), "tet4");
        EXPECT_TRUE(numbers_.insert(item->GetAttribute("id")).second) << "two elements of one number";
        model.regions[name].push_back(vertices_in<4>(item));
      } else if (kind == "Surface") {
        EXPECT_STREQ(item->GetName(), "tri3");
        model.surfaces[name].push_back(vertices_in<3>(item));
      } else if (kind == "Edge") {
        EXPECT_STREQ(item->GetName(), "line2");
        ++edges_;
      } else {
        ADD_FAILURE() << kind;
      }
    }
  }

  std::map<std::string, std::string> domains_;
  std::set<std::string> numbers_;
  std::size_t edges_ = 0;
};

using Feb = IoTest;

TEST_F(Feb, HoldsTheMeshByRegionsAndSurfaces) {
  for (const int labels : {1, 3, 116}) {
    SCOPED_TRACE(labels);
    const TetMesh mesh = make_labelled_cube(6, labels);
    const std::string path = file(std::to_string(labels) + ".feb");
    write_mesh(mesh, path);
    FebReader reader;
    const ReadModel expected = model_of(mesh);
    const ReadModel found = reader.read(path);
    expect_same_model(found, expected, 0);
    EXPECT_EQ(found.node_sets.size(), static_cast<std::size_t>(labels) + 1 + (mesh.corners.empty() ? 0 : 1));
    EXPECT_EQ(reader.edges(), mesh.curve_edges.size());
    EXPECT_EQ(found.node_sets.at("boundary"), vertices_of_surfaces(expected));
    EXPECT_EQ(found.node_sets.at("nodes_region_1"), vertices_of_region(expected, "region_1"));
    EXPECT_EQ(reader.domains().size(), static_cast<std::size_t>(labels));
    EXPECT_EQ(reader.domains().at("region_1"), "region_1") << "the material is asked for by the region's name";
  }
}

TEST_F(Feb, HasNamesThatXmlTakes) {
  const TetMesh mesh = make_named_cube();
  write_mesh(mesh, file("a.feb"), {true, "scantet --level 60 ---size 3-", "4.1"});
  TetMesh turned = mesh;
  for (Point& p : turned.vertices) p = {-p.x, -p.y, p.z};
  const std::map<std::string, std::string> names{
      {"Left kidney", "Left_kidney"}, {"left_Kidney", "left_Kidney_2"}, {"wall <\"&> -- of it", "wall______--_of_it"}};
  expect_same_model(FebReader().read(file("a.feb")), model_of(turned, names), 0);
  EXPECT_NE(content_of(file("a.feb")).find("<!-- SPACE=RAS; scantet - -level 60 - - -size 3- -->"), std::string::npos);
}

}  // namespace
}  // namespace scantet
