// The table of what each format holds, against what is in the files, against docs/formats.md, and what people are told.
#include "scantet/io/mesh_losses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <regex>
#include <sstream>

#include "io_test_support.h"

namespace scantet {
namespace {

using enum MeshExtra;

const std::vector<std::pair<MeshExtra, std::string>> kExtras{
    {node_sets, "held_nodes"}, {facet_sets, "held_facets"}, {tet_sets, "held_tets"},       {fields, "held_field"},
    {materials, "held_stuff"}, {curves, "held_rim"},        {region_names, "held_region"}, {patch_names, "held_patch"}};

/// A cube of two regions with everything that a mesh can carry, under the names of kExtras.
TetMesh make_loaded_cube() {
  TetMesh mesh = make_cube(2, 1, 2);
  mesh.region_names[1] = "held_region";
  for (MeshPatch& patch : mesh.patches) {
    if (patch.regions == std::array<Region, 2>{1, 0}) patch.name = "held_patch";
  }
  mesh.curves.push_back({{0, 1}, "held_rim", true});
  mesh.curve_edges.push_back({mesh.tets[0][0], mesh.tets[0][1]});
  mesh.edge_curves.push_back(static_cast<std::uint32_t>(mesh.curves.size() - 1));
  mesh.sets = {{"held_nodes", {0, 2}, {}, {}}, {"held_facets", {}, {0, 1}, {}}, {"held_tets", {}, {}, {0, 3}}};
  mesh.materials = {{"held_stuff", 17000, 0.3, 1.9e-9}};
  mesh.tet_materials.assign(mesh.tets.size(), 0);
  mesh.fields = {{"held_field", {}}, {kMaterialFields[0], {}}, {kMaterialFields[1], {}}, {kMaterialFields[2], {}}};
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    mesh.fields[0].values.push_back(static_cast<double>(t) / 3);
    mesh.fields[1].values.push_back(1);
    mesh.fields[2].values.push_back(17000);
    mesh.fields[3].values.push_back(1.9e-9);
  }
  return mesh;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// All that stands in the files and in their names; without comments of one line, if `comment` says how these begin.
std::string text_of(const std::string& path, char comment) {
  std::string text;
  for (const std::string& file : mesh_files(path)) {
    for (const std::string& part : files_at(file)) text += part + '\n' + content_of(part) + '\n';
  }
  if (comment == 0) return lower(text);
  std::istringstream lines(text);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] != comment) kept += line + '\n';
  }
  return lower(kept);
}

/// Whether the file holds what has the name. Some formats hold what has its name in a comment: sets and materials of
/// .bdf as cards, curves of .mesh as edges. What .vtu has of names of regions is compressed.
bool is_in_file(MeshExtra extra, const std::string& name, const std::string& path) {
  const std::string extension = path.substr(path.rfind('.'));
  const bool is_name = extra == region_names || extra == patch_names;
  if (extension == ".vtu" && is_name) return !read_mesh(path).region_names.empty() && extra == region_names;
  const char comment = is_name && extension == ".mesh" ? '#' : is_name && extension == ".bdf" ? '$' : '\0';
  const std::string text = text_of(path, comment);
  if (extension == ".mesh" && extra == curves) return text.find("\nedges\n") != std::string::npos;
  if (text.find(name) != std::string::npos) return true;
  return extra == materials && text.find(kMaterialFields[1]) != std::string::npos;
}

using MeshLosses = IoTest;

TEST_F(MeshLosses, TheTableSaysWhatIsInTheFiles) {
  const TetMesh mesh = make_loaded_cube();
  for (const MeshFormat& format : mesh_formats()) {
    const std::string path = file("a" + format.extension);
    write_mesh(mesh, path);
    for (const auto& [extra, name] : kExtras) {
      EXPECT_EQ(is_in_file(extra, name, path), format.can_hold(extra)) << format.extension << " " << name;
    }
  }
}

TEST_F(MeshLosses, WhatIsHeldIsReadBack) {
  const TetMesh mesh = make_loaded_cube();
  for (const MeshFormat& format : mesh_formats()) {
    if (!format.can_read) continue;
    SCOPED_TRACE(format.extension);
    write_mesh(mesh, file("a" + format.extension));
    const TetMesh read = read_mesh(file("a" + format.extension));
    const auto members = [&](const std::string& name, std::vector<std::uint32_t> MeshSet::*of) {
      for (const MeshSet& set : read.sets) {
        if (lower(set.name) == name) return set.*of;
      }
      return std::vector<std::uint32_t>();
    };
    using Members = std::vector<std::uint32_t>;
    const auto if_held = [&](MeshExtra extra, const Members& all) { return format.can_hold(extra) ? all : Members(); };
    EXPECT_EQ(members("held_nodes", &MeshSet::vertices), if_held(node_sets, {0, 2}));
    EXPECT_EQ(members("held_facets", &MeshSet::facets), if_held(facet_sets, {0, 1}));
    EXPECT_EQ(members("held_tets", &MeshSet::tets), if_held(tet_sets, {0, 3}));
    const bool is_named = std::any_of(read.region_names.begin(), read.region_names.end(),
                                      [](const auto& each) { return lower(each.second) == "held_region"; });
    EXPECT_EQ(is_named, format.can_hold(region_names));
    const auto field = std::find_if(read.fields.begin(), read.fields.end(),
                                    [](const MeshField& each) { return each.name == "held_field"; });
    ASSERT_EQ(field != read.fields.end(), format.can_hold(fields));
    if (field == read.fields.end()) continue;
    EXPECT_EQ(field->values, mesh.fields[0].values);
  }
}

TEST_F(MeshLosses, TheTableOfTheDocumentationIsTheSame) {
  std::istringstream lines(content_of(SCANTET_FORMATS_PAGE));
  const std::regex row("\\| [^|]*(\\| (yes|–|comment) ){8}\\|"), cell("yes|–|comment"), extension("`(\\.[a-z0-9-]+)`");
  std::map<std::string, std::string> held;  // by extension: a y or n of each of kExtras
  for (std::string line; std::getline(lines, line);) {
    if (!std::regex_match(line, row)) continue;
    std::string cells;
    const std::string rest = line.substr(line.find('|', 1));
    for (std::sregex_iterator at(rest.begin(), rest.end(), cell), end; at != end; ++at) {
      cells += at->str() == "yes" ? 'y' : 'n';
    }
    const std::string first = line.substr(0, line.find('|', 1));
    for (std::sregex_iterator at(first.begin(), first.end(), extension), end; at != end; ++at) {
      held[at->str(1)] = cells;
    }
  }
  std::map<std::string, std::string> table;
  for (const MeshFormat& format : mesh_formats()) {
    for (const auto& [extra, name] : kExtras) table[format.extension] += format.can_hold(extra) ? 'y' : 'n';
  }
  EXPECT_EQ(held, table);
}

TEST_F(MeshLosses, AreToldInOneLine) {
  TetMesh mesh = make_loaded_cube();
  EXPECT_EQ(loss_text(mesh, "a.msh", true), "");
  EXPECT_EQ(loss_text(mesh, "a.inp", true), "a.inp holds no fields (held_field)");
  EXPECT_EQ(loss_text(mesh, "b/a.vtu", true), "b/a.vtu holds no sets of facets (held_facets)");
  EXPECT_EQ(loss_text(mesh, "A.MESH", false),
            "A.MESH holds no sets (held_nodes, held_facets, held_tets), no fields (held_field) and no materials "
            "(held_stuff)");
  EXPECT_EQ(
      loss_text(mesh, "a.stls", true),
      "a.stls holds no sets of nodes (held_nodes), no sets of elements (held_tets), no fields (held_field) and no "
      "materials (held_stuff)");
  mesh.sets.clear();
  mesh.materials.clear();
  mesh.fields.push_back({"last", {}});
  EXPECT_EQ(loss_text(mesh, "a.bdf", true),
            "a.bdf holds no fields (held_field, material, youngs_modulus_mpa, density_tonne_per_mm3 and 1 more) and no "
            "names of regions that programs read (held_region)");
  mesh.fields.clear();
  for (const MeshFormat& format : mesh_formats()) EXPECT_EQ(loss_text(mesh, "a" + format.extension, false), "");
}

std::vector<std::string> left_out_of(const std::string& path, const std::string& content) {
  put_content(path, content);
  std::vector<std::string> left_out;
  read_mesh(path, left_out);
  return left_out;
}

TEST_F(MeshLosses, ReadersSayNothingOfOurOwnFiles) {
  TetMesh mesh = make_loaded_cube();
  mesh.curves.clear();
  mesh.curve_edges.clear();
  mesh.edge_curves.clear();
  mesh.materials.clear();
  mesh.tet_materials.clear();
  for (const MeshFormat& format : mesh_formats()) {
    if (!format.can_read) continue;
    write_mesh(mesh, file("a" + format.extension));
    std::vector<std::string> left_out;
    read_mesh(file("a" + format.extension), left_out);
    EXPECT_EQ(left_out, std::vector<std::string>()) << format.extension;
  }
}

TEST_F(MeshLosses, ReadersTellWhatTheyLeaveOut) {
  const std::string inp =
      "*HEADING\n*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n"
      "*NSET, NSET=ALL, GENERATE\n1, 4, 1\n*NSET, NSET=BOTH\nALL\n*SURFACE, NAME=S, TYPE=NODE\n1\n"
      "*MATERIAL, NAME=M\n*ELASTIC\n1, 0.3\n*MATERIAL, NAME=N\n*ELEMENT, TYPE=B31, ELSET=ROD\n2, 1, 2\n"
      "*NSET, NSET=OF, ELSET=ROD\n*ELSET, ELSET=RODS\n2\n";
  EXPECT_EQ(left_out_of(file("a.inp"), inp),
            (std::vector<std::string>{"*NSET 'ALL'", "*NSET 'BOTH'", "*SURFACE 'S'", "*MATERIAL", "*ELASTIC",
                                      "*ELEMENT 'ROD'", "*NSET 'OF'",
                                      "what of the set 'RODS' is neither tetrahedra nor triangles"}));
  const std::string vtk =
      "# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nFIELD FieldData 1\nTIME 1 1 double\n7\n"
      "POINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n"
      "POINT_DATA 4\nSCALARS heat double 1\nLOOKUP_TABLE default\n1 2 3 4\nVECTORS flow float\n0 0 0 0 0 0 0 0 0 0 0 "
      "0\n"
      "CELL_DATA 1\nFIELD FieldData 3\nbone%20share 1 1 float\n0.5\nlabel 1 1 int\n3\non_boundary 1 1 int\n1\n";
  EXPECT_EQ(left_out_of(file("a.vtk"), vtk),
            (std::vector<std::string>{"point array 'heat'", "point array 'flow'", "cell array 'label'"}));
  EXPECT_EQ(read_mesh(file("a.vtk")).fields.at(0).name, "bone_share");
  EXPECT_EQ(read_mesh(file("a.vtk")).fields.at(0).values, std::vector<double>{0.5});
  const std::string msh =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 5 \"rim\"\n1 6 \"curve_0_1_2\"\n1 7 "
      "\"curve_1\"\n$EndPhysicalNames\n"
      "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n"
      "$Periodic\n0\n$EndPeriodic\n$NodeData\n1\n\"heat\"\n1\n0\n3\n0\n1\n1\n1 2\n$EndNodeData\n"
      "$ElementData\n1\n\"none\"\n1\n0\n3\n0\n1\n0\n$EndElementData\n";
  EXPECT_EQ(left_out_of(file("a.msh"), msh),
            (std::vector<std::string>{"physical curve 'rim'", "physical curve 'curve_1'", "$Periodic",
                                      "$NodeData 'heat'", "$ElementData 'none', which some tetrahedra lack"}));
  const std::string medit =
      "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\nTetrahedra\n1\n1 2 3 4 1\n"
      "Corners\n1\n1\nRequiredVertices\n1\n2\nEnd\n";
  EXPECT_EQ(left_out_of(file("a.mesh"), medit), std::vector<std::string>{"'RequiredVertices'"});
}

}  // namespace
}  // namespace scantet
