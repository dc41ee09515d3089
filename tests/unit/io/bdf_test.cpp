// Nastran files, read back by columns.
#include <gtest/gtest.h>

#include <sstream>

#include "model_test_support.h"

namespace scantet {
namespace {

/// A number in Nastran's notation, where 1.5-7 is 1.5e-7.
double nastran_number(std::string text) {
  const std::size_t sign = text.find_first_of("+-", 1);
  if (sign != std::string::npos && text.find('e') == std::string::npos) text.insert(sign, "e");
  EXPECT_NE(text.find('.'), std::string::npos) << "an integer to Nastran: " << text;
  return std::stod(text);
}

/// The fields of a card, which begins with this line and may go on.
std::vector<std::string> fields_of(const std::string& line, std::istream& lines) {
  const bool is_large = line.substr(0, 8).find('*') != std::string::npos;
  const std::size_t width = is_large ? 16 : 8;
  const std::size_t per_line = is_large ? 4 : 8;
  std::vector<std::string> fields{line.substr(0, line.find_first_of(" *"))};
  std::string text = line;
  for (;;) {
    EXPECT_LE(text.size(), 8 + per_line * width) << text;
    for (std::size_t at = 8; at < text.size(); at += width) {
      std::string field = text.substr(at, width);
      field.erase(0, std::min(field.find_first_not_of(' '), field.size()));
      field.erase(field.find_last_not_of(' ') + 1);
      fields.push_back(field);
    }
    if (lines.peek() != '*' && lines.peek() != '+') return fields;
    std::getline(lines, text);
  }
}

class Bdf : public IoTest {
 protected:
  static ReadModel read(const std::string& path) {
    std::ifstream lines(path);
    ReadModel model;
    std::map<std::string, std::string> names;
    std::set<std::string> elements;
    std::string line;
    std::string set;  // whose card this is: sets come last, and what is in them tests/fem/formats_read_back.py reads
    while (std::getline(lines, line) && line != "BEGIN BULK") {
    }
    while (std::getline(lines, line) && line != "ENDDATA") {
      constexpr std::string_view kProperty = "$ property ";
      if (line.starts_with(kProperty)) {
        const std::size_t colon = line.find(": ");
        names[line.substr(kProperty.size(), colon - kProperty.size())] = line.substr(colon + 2);
        continue;
      }
      if (line.starts_with("$ set ")) {
        set = line.substr(line.find(": ") + 2);
        EXPECT_TRUE(model.node_sets.try_emplace(set).second) << line;
      }
      if (!set.empty()) continue;
      const std::vector<std::string> fields = fields_of(line, lines);
      const auto vertex = [&](std::size_t i) { return static_cast<VertexId>(std::stoul(fields.at(i)) - 1); };
      if (fields[0] == "GRID") {
        EXPECT_EQ(fields.at(1), std::to_string(model.vertices.size() + 1));
        EXPECT_EQ(fields.at(2), "");
        model.vertices.push_back({nastran_number(fields.at(3)), nastran_number(fields.at(4)),  //
                                  nastran_number(fields.at(5))});
        EXPECT_EQ(fields.size(), 6U);
      } else if (fields[0] == "CTETRA") {
        model.regions[names.at(fields.at(2))].push_back({vertex(3), vertex(4), vertex(5), vertex(6)});
        EXPECT_EQ(fields.size(), 7U);
      } else if (fields[0] == "CTRIA3") {
        model.surfaces[names.at(fields.at(2))].push_back({vertex(3), vertex(4), vertex(5)});
        EXPECT_EQ(fields.size(), 6U);
      } else {
        EXPECT_TRUE(fields[0] == "PSOLID" || fields[0] == "PSHELL") << line;
        EXPECT_TRUE(names.contains(fields.at(1)));
        EXPECT_EQ(fields.at(1), fields.at(2)) << "the material of the property's number";
      }
      if (fields[0][0] == 'C') {
        EXPECT_TRUE(elements.insert(fields.at(1)).second) << "two elements of one number";
      }
    }
    EXPECT_EQ(line, "ENDDATA");
    return model;
  }
};

TEST_F(Bdf, HoldsTheMeshByProperties) {
  for (const int labels : {1, 3, 116}) {
    SCOPED_TRACE(labels);
    const TetMesh mesh = make_labelled_cube(6, labels);
    const std::string path = file(std::to_string(labels) + ".bdf");
    write_mesh(mesh, path);
    const ReadModel found = read(path);
    expect_same_model(found, model_of(mesh), 1e-11);
    EXPECT_EQ(found.node_sets.size(), sets_of_curves(mesh));
  }
}

TEST_F(Bdf, CommentsHaveTheNames) {
  const TetMesh mesh = make_named_cube();
  write_mesh(mesh, file("a.bdf"));
  const std::map<std::string, std::string> names{
      {"Left kidney", "Left_kidney"}, {"left_Kidney", "left_Kidney_2"}, {"wall <\"&> -- of it", "wall______--_of_it"}};
  expect_same_model(read(file("a.bdf")), model_of(mesh, names), 1e-11);
}

TEST_F(Bdf, LargeNumbersOfRegionsTakeWideFields) {
  const TetMesh mesh = make_cube(2, 1, 123'456'789);
  write_mesh(mesh, file("a.bdf"));
  EXPECT_NE(content_of(file("a.bdf")).find("\nPSOLID* 123456789"), std::string::npos);
  expect_same_model(read(file("a.bdf")), model_of(mesh), 1e-11);
}

TEST_F(Bdf, CoordinatesKeepTheDigitsThatFit) {
  TetMesh mesh;
  mesh.vertices = {{0, -0.0, 1},
                   {100, 0.5, 1e-20},
                   {-123.45678901234567, 0.00012345678901234567, 123456.78901234567},
                   {-1.2345678901234567e-7, 1.5e-7, 1e22},
                   {-98765432109876.5, 0.1 + 0.2, 1e300}};
  mesh.tets = {{0, 1, 2, 3}, {0, 1, 2, 4}};
  mesh.tet_regions = {1, 1};
  build_boundary(mesh);
  write_mesh(mesh, file("a.bdf"));
  const std::vector<Point> read_back = read(file("a.bdf")).vertices;
  ASSERT_EQ(read_back.size(), mesh.vertices.size());
  EXPECT_EQ(read_back[0], mesh.vertices[0]);
  EXPECT_EQ(read_back[1], mesh.vertices[1]);
  for (std::size_t v = 0; v < read_back.size(); ++v) {
    const auto near = [](double a, double b) { EXPECT_LE(std::abs(a - b), 1e-11 * std::abs(b)) << b; };
    near(read_back[v].x, mesh.vertices[v].x);
    near(read_back[v].y, mesh.vertices[v].y);
    near(read_back[v].z, mesh.vertices[v].z);
  }
  const std::string text = content_of(file("a.bdf"));
  for (const char* number : {"-123.45678901235", "1.234567890123-4", "-1.23456789012-7", "1.5-7", "1.+22", "1.+300",
                             "-98765432109876.", ".3  "}) {
    EXPECT_NE(text.find(number), std::string::npos) << number;
  }
}

}  // namespace
}  // namespace scantet
