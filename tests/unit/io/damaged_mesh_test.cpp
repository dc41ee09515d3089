// Files that are not what they claim to be. Whatever is in a file: an Error that names it, or a mesh; never a crash.
#include <gtest/gtest.h>

#include <random>

#include "io_test_support.h"
#include "scantet/io/mesh_io.h"

namespace scantet {
namespace {

std::vector<MeshFormat> readable_formats() {
  std::vector<MeshFormat> formats = mesh_formats();
  std::erase_if(formats, [](const MeshFormat& format) { return !format.can_read; });
  return formats;
}

class DamagedMesh : public IoTest, public testing::WithParamInterface<MeshFormat> {
 protected:
  std::string path() const { return file("mesh" + GetParam().extension); }

  void expect_bad(const std::string& code = "input.bad_mesh") const {
    const Error error = error_of([&] { read_mesh(path()); });
    EXPECT_EQ(error.code(), code) << error.what();
    EXPECT_EQ(error.fault(), Fault::input);
    EXPECT_NE(std::string(error.what()).find(path()), std::string::npos) << error.what();
    EXPECT_FALSE(error.remedy().empty());
  }
};

TEST_P(DamagedMesh, MissingFoldersEmptyAndForeignFiles) {
  expect_bad("input.cannot_open");
  put_content(path(), "");
  expect_bad();
  for (const char* content : {"\n", "hello", "\xff\xfe\x00\x01", "$", "<VTKFile", "# vtk DataFile Version 4.2\n"}) {
    put_content(path(), content);
    SCOPED_TRACE(content);
    const Error error = error_of([&] { read_mesh(path()); });
    EXPECT_EQ(error.fault(), Fault::input);
  }
  std::filesystem::remove(path());
  std::filesystem::create_directory(path());
  expect_bad("input.cannot_open");
}

TEST_P(DamagedMesh, ACutFileIsAnErrorUnlessTheMeshIsWhole) {
  const TetMesh mesh = make_cube(2, 1, 2);
  write_mesh(mesh, path());
  const std::string whole = content_of(path());
  int refused = 0;
  int cuts = 0;
  for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 200) {
    put_content(path(), whole.substr(0, size));
    ++cuts;
    try {
      EXPECT_EQ(read_mesh(path()).tets, mesh.tets) << "cut at " << size << " of " << whole.size();
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::input) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, cuts / 2);
}

TEST_P(DamagedMesh, ChangedBytesNeverCrash) {
  write_mesh(make_cube(2, 1, 2), path());
  const std::string whole = content_of(path());
  std::mt19937 random(7);
  int read = 0;
  for (int i = 0; i < 300; ++i) {
    std::string damaged = whole;
    const unsigned changes = 1 + random() % 8;
    for (unsigned change = 0; change < changes; ++change) {
      damaged[random() % damaged.size()] = static_cast<char>(random() % 256);
    }
    put_content(path(), damaged);
    try {
      const TetMesh mesh = read_mesh(path());
      ++read;
      EXPECT_EQ(mesh.tet_regions.size(), mesh.tets.size());
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::input) << error.what();
    }
  }
  EXPECT_LT(read, 300);
}

INSTANTIATE_TEST_SUITE_P(EveryReadableFormat, DamagedMesh, testing::ValuesIn(readable_formats()),
                         [](const auto& test) { return test.param.extension.substr(1); });

std::string attributes(int count) {
  std::string text;
  for (int n = 0; n < count; ++n) text += " a" + std::to_string(n) + "=\"\"";
  return text;
}

struct BadText {
  std::string name;
  std::string file_name;
  std::string content;
  std::string code;
  std::string says;
};

void PrintTo(const BadText& bad, std::ostream* out) {
  *out << bad.name;
}

const std::string kMedit = "MeshVersionFormatted 2\nDimension 3\n";
const std::string kFourVertices = "Vertices 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n";
const std::string kMsh2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string kMsh4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const std::string kMsh2Nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
const std::string kInpNodes = "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n";
const std::string kVtk = "# vtk DataFile Version 4.2\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n";

std::string vtu(const std::string& counts, const std::string& connectivity) {
  return "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
         "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece " +
         counts +
         ">\n<Points><DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 "
         "0 1 0 "
         "0 0 1</DataArray></Points>\n<Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">" +
         connectivity +
         "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4</DataArray><DataArray "
         "type=\"UInt8\" "
         "Name=\"types\" format=\"ascii\">10</DataArray></Cells>\n</Piece></UnstructuredGrid></VTKFile>\n";
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

std::string inp_elements(int count) {
  std::string text = kInpNodes + "*ELEMENT, TYPE=C3D4\n";
  for (int n = 1; n <= count; ++n) text += std::to_string(n) + ",1,2,3,4\n";
  return text;
}

/// With raw appended data: a word of four bytes for each of the numbers, then zeros.
std::string vtu_appended(const std::string& attributes, const std::string& pieces, const std::vector<unsigned>& words,
                         std::size_t zeros) {
  std::string text = "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"" + attributes +
                     ">\n<UnstructuredGrid>" + pieces + "</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  for (const unsigned word : words) {
    for (unsigned shift = 0; shift < 32; shift += 8) text.push_back(static_cast<char>(word >> shift & 0xFF));
  }
  return text + std::string(zeros, '\0') + "\n</AppendedData></VTKFile>\n";
}

const std::string kAppendedPiece =
    "<Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"><Cells><DataArray type=\"Int64\" Name=\"connectivity\" "
    "format=\"appended\" offset=\"0\"/></Cells></Piece>\n";

std::string doubled_connectivity() {
  std::string text = vtu("NumberOfPoints=\"4\" NumberOfCells=\"1\"", "0 1 2 3");
  const std::size_t begin = text.find("<DataArray type=\"Int64\" Name=\"connectivity\"");
  const std::size_t end = text.find("<DataArray type=\"Int64\" Name=\"offsets\"");
  return text.insert(end, text.substr(begin, end - begin));
}

const std::vector<BadText> kBadTexts = {
    {"medit_huge_vertices", "a.mesh", kMedit + "Vertices 1000000000000\n0 0 0 0\n", "input.bad_mesh", "line 3"},
    {"medit_negative_count", "a.mesh", kMedit + "Vertices -4\n", "input.bad_mesh", "-4 is impossible"},
    {"medit_huge_tets", "a.mesh", kMedit + kFourVertices + "Tetrahedra 99999999999\n1 2 3 4 1\n", "input.bad_mesh",
     "impossible"},
    {"medit_word", "a.mesh", kMedit + "Vertices 4\n0 zero 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n", "input.bad_mesh",
     "line 4: a number is expected, not 'zero'"},
    {"medit_nan", "a.mesh", kMedit + "Vertices 4\n0 nan 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n", "input.bad_mesh", "finite"},
    {"medit_index_zero", "a.mesh", kMedit + kFourVertices + "Tetrahedra 1\n0 2 3 4 1\nEnd\n", "input.bad_mesh",
     "tet 0 (from 0) uses a vertex that does not exist (there are 4)"},
    {"medit_index_large", "a.mesh", kMedit + kFourVertices + "Tetrahedra 1\n1 2 3 5 1\nEnd\n", "input.bad_mesh",
     "tet 0"},
    {"medit_plane", "a.mesh", "MeshVersionFormatted 2\nDimension 2\n", "input.bad_mesh", "three-dimensional"},
    {"medit_reference", "a.mesh", kMedit + kFourVertices + "Tetrahedra 1\n1 2 3 4 3000000000\nEnd\n", "input.bad_mesh",
     "range of a tag"},
    {"medit_no_tets", "a.mesh", kMedit + kFourVertices + "Triangles 1\n1 2 3 0\nEnd\n", "input.no_tets",
     "4 vertices, 1 cells"},
    {"msh_binary", "a.msh", "$MeshFormat\n4.1 1 8\n", "input.bad_mesh", "binary"},
    {"msh_version", "a.msh", "$MeshFormat\n4.0 0 8\n$EndMeshFormat\n", "input.bad_mesh", "version '4.0'"},
    {"msh_huge_nodes", "a.msh", kMsh2 + "$Nodes\n999999999999999\n1 0 0 0\n", "input.bad_mesh", "impossible"},
    {"msh_twice", "a.msh", kMsh2 + "$Nodes\n2\n1 0 0 0\n1 0 0 1\n$EndNodes\n", "input.bad_mesh",
     "node 1 is there twice"},
    {"msh_unknown_node", "a.msh", kMsh2 + kMsh2Nodes + "$Elements\n1\n1 4 0 1 2 3 9\n$EndElements\n", "input.bad_mesh",
     "node 9"},
    {"msh_no_tets", "a.msh", kMsh2 + kMsh2Nodes + "$Elements\n1\n1 2 0 1 2 3\n$EndElements\n", "input.no_tets",
     "1 cells of other types"},
    {"msh_endless_section", "a.msh", kMsh2 + "$Extra\n1 2 3\n", "input.bad_mesh", "$EndExtra is missing"},
    {"msh4_count_lies", "a.msh", kMsh4 + "$Nodes\n1 3 1 3\n3 1 0 2\n1\n2\n0 0 0\n1 0 0\n$EndNodes\n", "input.bad_mesh",
     "another number of nodes"},
    {"msh4_huge_block", "a.msh", kMsh4 + "$Nodes\n1 4 1 4\n3 1 0 4000000000000\n1\n", "input.bad_mesh", "impossible"},
    {"vtk_huge_points", "a.vtk", kVtk + "POINTS 1000000000000 double\n0 0 0\n", "input.bad_mesh", "1000000000000"},
    {"vtk_huge_cells", "a.vtk", kVtk + "POINTS 1 double\n0 0 0\nCELLS 100000000000 500000000000\n", "input.bad_mesh",
     "100000000000"},
    {"vtk_image", "a.vtk", "# vtk DataFile Version 4.2\nt\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 2\n",
     "input.no_tets", "it holds 'STRUCTURED_POINTS'"},
    {"vtk_no_cells", "a.vtk", kVtk + "POINTS 1 double\n0 0 0\n", "input.no_tets", "no tetrahedra"},
    {"vtk_index", "a.vtk", kVtk + "POINTS 1 double\n0 0 0\nCELLS 1 5\n4 0 0 0 7\nCELL_TYPES 1\n10\n", "input.bad_mesh",
     "vertex that does not exist"},
    {"vtk_short_tet", "a.vtk", kVtk + "POINTS 1 double\n0 0 0\nCELLS 1 4\n3 0 0 0\nCELL_TYPES 1\n10\n",
     "input.bad_mesh", "does not have four vertices"},
    {"vtk_regions", "a.vtk",
     kVtk + "POINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\nCELL_DATA 1\nSCALARS "
            "region double 1\nLOOKUP_TABLE default\n1.5\n",
     "input.bad_mesh", "no region number"},
    {"vtu_huge_points", "a.vtu", vtu("NumberOfPoints=\"1000000000000\" NumberOfCells=\"1\"", "0 1 2 3"),
     "input.bad_mesh", "'Points' has 12 values instead of 3000000000000"},
    {"vtu_negative_cells", "a.vtu", vtu("NumberOfPoints=\"4\" NumberOfCells=\"-1\"", "0 1 2 3"), "input.bad_mesh",
     "NumberOfCells is '-1'"},
    {"vtu_index", "a.vtu", vtu("NumberOfPoints=\"4\" NumberOfCells=\"1\"", "0 1 2 4"), "input.bad_mesh",
     "uses a vertex that does not exist"},
    {"vtu_short_tet", "a.vtu", vtu("NumberOfPoints=\"4\" NumberOfCells=\"1\"", "0 1 2"), "input.bad_mesh",
     "does not have four vertices"},
    {"vtu_other_type", "a.vtu", "<VTKFile type=\"PolyData\"></VTKFile>", "input.no_tets", "PolyData"},
    {"vtu_compressor", "a.vtu", "<VTKFile type=\"UnstructuredGrid\" compressor=\"vtkFancy\"></VTKFile>",
     "input.bad_mesh", "unknown method 'vtkFancy'"},
    {"inp_no_keyword", "a.inp", "1, 2, 3\n", "input.bad_mesh", "line 1: a keyword is expected, not '1, 2, 3'"},
    {"inp_word", "a.inp", "*NODE\n1, 0, zero, 0\n", "input.bad_mesh", "line 2: a number is expected, not 'zero'"},
    {"inp_short_node", "a.inp", "*NODE\n1, 0, 0\n", "input.bad_mesh", "three coordinates"},
    {"inp_nan", "a.inp", "*NODE\n1, 0, nan, 0\n", "input.bad_mesh", "not finite"},
    {"inp_node_twice", "a.inp", kInpNodes + kInpNodes + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n", "input.bad_mesh",
     "node 1 is there twice"},
    {"inp_element_twice", "a.inp", kInpNodes + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n1, 1, 2, 3, 4\n", "input.bad_mesh",
     "element 1 is there twice"},
    {"inp_unknown_node", "a.inp", kInpNodes + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 9\n", "input.bad_mesh", "node 9"},
    {"inp_short_element", "a.inp", kInpNodes + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3\n", "input.bad_mesh", "four nodes"},
    {"inp_long_element", "a.inp", kInpNodes + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4, 1\n", "input.bad_mesh",
     "four nodes"},
    {"inp_negative_element", "a.inp", kInpNodes + "*ELEMENT, TYPE=C3D4\n-1, 1, 2, 3, 4\n", "input.bad_mesh",
     "-1 is not positive"},
    {"inp_cut_in_a_line", "a.inp", kInpNodes + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4", "input.bad_mesh",
     "ends in the middle of the mesh"},
    {"inp_cut_in_an_element", "a.inp", kInpNodes + "*ELEMENT, TYPE=C3D4\n1, 1, 2,\n", "input.bad_mesh",
     "ends in the middle of the mesh"},
    {"inp_cut_at_a_line", "a.inp", "** SPACE=LPS\n" + kInpNodes + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n",
     "input.bad_mesh", "before the set EALL"},
    {"inp_ranges_of_everything", "a.inp",
     inp_elements(1000) + "*ELSET, ELSET=REGION_2, GENERATE\n" + repeated("1,1000\n", 1000), "input.bad_mesh",
     "its sets of elements overlap too often"},
    {"inp_zero_step", "a.inp", kInpNodes + "*ELSET, ELSET=REGION_2, GENERATE\n1, 9, 0\n", "input.bad_mesh",
     "0 is not positive"},
    {"inp_no_type", "a.inp", kInpNodes + "*ELEMENT\n1, 1, 2, 3, 4\n", "input.bad_mesh", "no TYPE"},
    {"inp_other_type", "a.inp", kInpNodes + "*Element, type=C3D8\n1, 1, 2, 3, 4, 5, 6, 7, 8\n", "input.inp",
     "line 6: elements of type 'C3D8' are not read, only C3D4 and C3D10"},
    {"inp_include", "a.inp", "*INCLUDE, INPUT=mesh.inp\n", "input.inp", "*INCLUDE"},
    {"inp_moved_part", "a.inp", "*INSTANCE, NAME=A, PART=B\n1., 2., 3.\n", "input.bad_mesh", "not '1., 2., 3.'"},
    {"inp_input", "a.inp", "*NODE, INPUT=nodes.txt\n", "input.inp", "another file"},
    {"inp_cylinder", "a.inp", "*NODE, SYSTEM=C\n1, 1, 90, 0\n", "input.inp", "rectangular"},
    {"inp_no_tets", "a.inp", kInpNodes + "*ELEMENT, TYPE=S3\n1, 1, 2, 3\n", "input.no_tets", "4 vertices, 1 cells"},
    {"vtu_array_twice", "a.vtu", doubled_connectivity(), "input.bad_mesh", "the array 'connectivity' is there twice"},
    {"vtu_bomb", "a.vtu",
     vtu_appended(" compressor=\"vtkZLibDataCompressor\"", kAppendedPiece, {1, 100000000, 0, 100000}, 100000),
     "input.bad_mesh", "far larger than the file can hold"},
    {"vtu_one_array_for_many_pieces", "a.vtu", vtu_appended("", repeated(kAppendedPiece, 1000), {100000}, 100000),
     "input.bad_mesh", "far larger than the file can hold"},
    {"vtu_deep", "a.vtu",
     "<VTKFile type=\"UnstructuredGrid\">" + repeated("<a>", 200000) + repeated("</a>", 200000) + "</VTKFile>",
     "input.bad_mesh", "nested too deeply"},
    {"vtu_many_attributes", "a.vtu", "<VTKFile type=\"UnstructuredGrid\"><a" + attributes(5000) + "/></VTKFile>",
     "input.bad_mesh", "too many attributes"},
    {"vtu_not_xml", "a.vtu", "<VTKFile type=\"UnstructuredGrid\"><oops", "input.bad_mesh", ""},
};

class BadTextMesh : public IoTest, public testing::WithParamInterface<BadText> {};

TEST_P(BadTextMesh, SaysWhatIsWrong) {
  const BadText& bad = GetParam();
  put_content(file(bad.file_name), bad.content);
  testing::internal::CaptureStderr();
  const Error error = error_of([&] { read_mesh(file(bad.file_name)); });
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(error.code(), bad.code) << error.what();
  EXPECT_EQ(error.fault(), Fault::input);
  EXPECT_NE(std::string(error.what()).find(bad.says), std::string::npos) << error.what();
  EXPECT_NE(std::string(error.what()).find(file(bad.file_name)), std::string::npos) << error.what();
}

INSTANTIATE_TEST_SUITE_P(Every, BadTextMesh, testing::ValuesIn(kBadTexts),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace scantet
