// Fields of tets in mesh files, as other programs and libraries find them.
#include <gtest/gtest.h>
#include <vtk_exodusII.h>

#include <cstdlib>
#include <fstream>

#include "hdf5_test_support.h"
#include "model_test_support.h"
#include "scantet/io/mesh_io.h"

namespace scantet {
namespace {

class FieldFiles : public IoTest {
 protected:
  void SetUp() override {
    IoTest::SetUp();
    mesh_ = make_cube(2, 1, 2);
    mesh_.fields = {{"density", {}}, {"bone_share", {}}};
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      mesh_.fields[0].values.push_back(0.1 + 17.0 * static_cast<double>(t) / 3);
      mesh_.fields[1].values.push_back(1.0 / static_cast<double>(t + 1));
    }
  }
  void write(const std::string& name) const { write_mesh(mesh_, file(name)); }

  TetMesh mesh_;
};

TEST_F(FieldFiles, ExodusHasThemAsElementVariables) {
  write("a.exo");
  int own_reals = sizeof(double);
  int file_reals = 0;
  float version = 0;
  const int id = ex_open(file("a.exo").c_str(), EX_READ, &own_reals, &file_reals, &version);
  ASSERT_GE(id, 0);
  int count = 0;
  EXPECT_EQ(ex_get_variable_param(id, EX_ELEM_BLOCK, &count), 0);
  EXPECT_EQ(count, 2);
  char name[256] = "";
  EXPECT_EQ(ex_get_variable_name(id, EX_ELEM_BLOCK, 2, name), 0);
  EXPECT_STREQ(name, "bone_share");
  std::vector<double> found;
  for (const Region region : {1, 2}) {
    const auto of_region = std::count(mesh_.tet_regions.begin(), mesh_.tet_regions.end(), region);
    std::vector<double> values(static_cast<std::size_t>(of_region));
    EXPECT_EQ(ex_get_var(id, 1, EX_ELEM_BLOCK, 1, region, of_region, values.data()), 0);
    found.insert(found.end(), values.begin(), values.end());
  }
  ex_close(id);
  std::vector<double> written;
  for (const Region region : {1, 2}) {
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      if (mesh_.tet_regions[t] == region) written.push_back(mesh_.fields[0].values[t]);
    }
  }
  EXPECT_EQ(found, written);
}

TEST_F(FieldFiles, MedAndXdmfHaveThemAsArrays) {
  write("a.med");
  write("a.xdmf");
  const std::string step = "/-0000000000000000001-0000000000000000001/MAI.TE4/MED_NO_PROFILE_INTERNAL/CO";
  for (const MeshField& field : mesh_.fields) {
    EXPECT_EQ(numbers_in<double>(file("a.med"), "/CHA/" + field.name + step, H5T_NATIVE_DOUBLE), field.values);
    EXPECT_EQ(numbers_in<double>(file("a.h5"), "/mesh/fields/" + field.name, H5T_NATIVE_DOUBLE), field.values);
    EXPECT_NE(content_of(file("a.xdmf")).find("<Attribute Name=\"" + field.name + "\""), std::string::npos);
  }
}

TEST_F(FieldFiles, MeshioReadsThemFromVtkAndGmsh) {
  if (std::string(SCANTET_PYTHON_WITH_MESHIO).empty()) GTEST_SKIP() << "meshio was not found";
  std::ofstream script(file("check.py"));
  script << "import meshio, numpy, sys\n"
            "expected = {'density': 0.1 + 17.0 * numpy.arange(48) / 3, 'bone_share': 1 / (numpy.arange(48) + 1.0)}\n"
            "for name in sys.argv[1:]:\n"
            "    mesh = meshio.read(name)\n"
            "    for field, values in expected.items():\n"
            "        found = [d for c, d in zip(mesh.cells, mesh.cell_data[field]) if c.type == 'tetra']\n"
            "        found = numpy.concatenate(found).ravel()\n"
            "        assert sorted(found) == sorted(values), (name, field, found, values)\n";
  script.close();
  for (const char* name : {"a.vtu", "a.vtk", "a.msh"}) write(name);  // of version 2.2 meshio reads no cell data
  const std::string command =
      "cd '" + folder_.string() + "' && '" + SCANTET_PYTHON_WITH_MESHIO + "' check.py a.vtu a.vtk a.msh > log 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << content_of(file("log"));
}

TEST_F(FieldFiles, MedsOwnLibraryReadsThem) {
  if (std::system("command -v mdump4 > /dev/null 2>&1") != 0) GTEST_SKIP() << "mdump4 was not found";
  write("a.med");
  const std::string command = "cd '" + folder_.string() + "' && mdump4 a.med NODALE FULL_INTERLACE 0 > log 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  const std::string log = content_of(file("log"));
  EXPECT_EQ(log.find("Erreur"), std::string::npos) << log;
  EXPECT_NE(log.find("CHAMP |density|"), std::string::npos) << log;
  EXPECT_NE(log.find("de type geometrique MED_TETRA4"), std::string::npos) << log;
}

TEST_F(FieldFiles, FilesWithoutFieldsHaveNoTraceOfThem) {
  mesh_.fields.clear();
  write("a.msh");
  EXPECT_EQ(content_of(file("a.msh")).find("ElementData"), std::string::npos);
}

}  // namespace
}  // namespace scantet
