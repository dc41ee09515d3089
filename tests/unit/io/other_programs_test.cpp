// What Gmsh, meshio and CalculiX make of our files. A test whose program was not found when the tests were configured
// is skipped.
#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>
#include <sstream>

#include "io_test_support.h"
#include "scantet/io/mesh_io.h"

namespace scantet {
namespace {

constexpr int kCells = 4;  // 125 vertices, 384 tets, 192 facets outside and 32 between the regions

class OtherPrograms : public IoTest {
 protected:
  /// Runs a command in the test's folder; returns its exit status and puts what it printed into log_.
  int run(const std::string& command) {
    const int status = std::system(
        ("cd '" + folder_.string() + "' && OMP_NUM_THREADS=1 " + command + " > log 2>&1 < /dev/null").c_str());
    log_ = content_of(file("log"));
    return status;
  }

  void write(const std::string& name, const MeshWriteOptions& options = {false, "scantet test", "4.1"}) const {
    write_mesh(mesh_, file(name), options);
  }

  /// That a copy has all of the mesh's tets, none turned over.
  void expect_whole(const TetMesh& copy) const {
    EXPECT_EQ(copy.tets.size(), mesh_.tets.size());
    EXPECT_TRUE(all_positive(copy));
    EXPECT_NEAR(volume_mm3(copy), 1000, 1e-6);
  }

  const TetMesh mesh_ = make_cube(kCells, 1, 2);
  std::string log_;
};

class Gmsh : public OtherPrograms {
 protected:
  void SetUp() override {
    OtherPrograms::SetUp();
    if (std::string(SCANTET_GMSH).empty()) GTEST_SKIP() << "gmsh was not found";
  }

  /// Gmsh reads the file, finds it coherent, and writes it as `copy`.
  void pass_through(const std::string& name, const std::string& copy, const std::string& format) {
    SCOPED_TRACE(name);
    EXPECT_EQ(run(std::string("'") + SCANTET_GMSH + "' " + name + " -check"), 0) << log_;
    EXPECT_FALSE(complaint()) << log_;
    const std::string save = " -save -setnumber Mesh.SaveAll 0 -format " + format + " -o " + copy;
    EXPECT_EQ(run(std::string("'") + SCANTET_GMSH + "' " + name + save), 0) << log_;
    EXPECT_FALSE(complaint()) << log_;
  }
  bool complaint() const {
    return log_.find("Error ") != std::string::npos || log_.find("Warning ") != std::string::npos;
  }
};

TEST_F(Gmsh, ReadsAndRewritesItsOwnFormats) {
  write("a.msh");
  write("b.msh2");
  for (const char* name : {"a.msh", "b.msh2"}) {
    pass_through(name, "copy.msh", "msh41");
    const TetMesh copy = read_mesh(file("copy.msh"));
    EXPECT_EQ(copy.vertices.size(), mesh_.vertices.size());
    expect_whole(copy);
    EXPECT_EQ(std::count(copy.tet_regions.begin(), copy.tet_regions.end(), 2), 192);
    EXPECT_EQ(copy.boundary_facets.size(), mesh_.boundary_facets.size());
    const std::string text = content_of(file("copy.msh"));
    for (const char* group :
         {"\"region_1\"", "\"region_2\"", "\"boundary_1_0\"", "\"boundary_1_2\"", "\"boundary_2_0\""}) {
      EXPECT_NE(text.find(group), std::string::npos) << group;
    }
  }
}

TEST_F(Gmsh, OtherVersionsOfItsFormatAreRead) {
  write("a.msh");
  pass_through("a.msh", "copy.msh2", "msh22");
  const TetMesh copy = read_mesh(file("copy.msh2"));
  EXPECT_EQ(copy.tets.size(), mesh_.tets.size());
  EXPECT_EQ(copy.boundary_facets.size(), mesh_.boundary_facets.size());
}

TEST_F(Gmsh, ItsAbaqusFilesAreReadWithTheirRegions) {
  write("a.msh");
  pass_through("a.msh", "copy.inp", "inp");
  const TetMesh copy = read_mesh(file("copy.inp"));
  expect_whole(copy);
  EXPECT_EQ(std::count(copy.tet_regions.begin(), copy.tet_regions.end(), 2), 192);
  EXPECT_EQ(copy.boundary_facets.size(), mesh_.boundary_facets.size());
}

TEST_F(Gmsh, ReadsAndRewritesMedit) {
  write("a.mesh");
  pass_through("a.mesh", "copy.mesh", "mesh");
  const TetMesh copy = read_mesh(file("copy.mesh"));
  expect_whole(copy);
  EXPECT_EQ(std::count(copy.tet_regions.begin(), copy.tet_regions.end(), 2), 192);
}

TEST_F(Gmsh, ReadsNastran) {
  write("a.bdf");
  pass_through("a.bdf", "copy.msh", "msh41");
  const TetMesh copy = read_mesh(file("copy.msh"));
  expect_whole(copy);
}

TEST_F(Gmsh, ReadsAndRewritesLegacyVtk) {
  write("a.vtk");
  pass_through("a.vtk", "copy.vtk", "vtk");
  const TetMesh copy = read_mesh(file("copy.vtk"));
  expect_whole(copy);
}

class Meshio : public OtherPrograms {
 protected:
  void SetUp() override {
    OtherPrograms::SetUp();
    if (std::string(SCANTET_PYTHON_WITH_MESHIO).empty()) GTEST_SKIP() << "no python3 with meshio was found";
  }
  int run_python(const std::string& program) {
    put_content(file("program.py"), program);
    return run(std::string("'") + SCANTET_PYTHON_WITH_MESHIO + "' program.py");
  }
};

const std::string kMeasure = R"(
import sys, meshio, numpy
def measure(name, kind):
    mesh = meshio.read(name, file_format=kind)
    tets = numpy.concatenate([b.data for b in mesh.cells if b.type == 'tetra'])
    corner = mesh.points[tets]
    volumes = numpy.linalg.det(corner[:, 1:] - corner[:, :1]) / 6
    assert (volumes > 0).all()
    triangles = sum(len(b.data) for b in mesh.cells if b.type == 'triangle')
    print(name, len(mesh.points), len(tets), triangles, round(volumes.sum(), 6))
    return mesh
)";

TEST_F(Meshio, ReadsEveryFormatWithTets) {
  for (const char* name : {"a.vtu", "a.vtk", "a.mesh", "a.msh", "b.msh2", "a.inp", "a.bdf"}) write(name);
  const std::string program = kMeasure + R"(
vtu = measure('a.vtu', None)
assert sorted(numpy.concatenate(vtu.cell_data['region'])) == [1] * 192 + [2] * 192
assert vtu.point_data['on_boundary'].sum() == 107
assert bytes(vtu.field_data['provenance']) == b'SPACE=LPS; scantet test'
vtk = measure('a.vtk', None)
assert sorted(numpy.concatenate(vtk.cell_data['region'])) == [1] * 192 + [2] * 192
mesh = measure('a.mesh', None)
assert mesh.point_data['medit:ref'].sum() == 107
assert sorted(set(numpy.concatenate(mesh.cell_data['medit:ref']))) == [1, 2, 3, 4, 5, 6]
for name in 'a.msh', 'b.msh2':
    msh = measure(name, 'gmsh')
    assert {k: list(v) for k, v in msh.field_data.items()} == {'boundary_1_0': [3, 2], 'boundary_1_2': [4, 2],
        'boundary_2_0': [5, 2], 'region_1': [1, 3], 'region_2': [2, 3], 'curve_0_1_2': [6, 1]}, msh.field_data
inp = measure('a.inp', 'abaqus')
assert len(inp.point_sets['BOUNDARY']) == 107
assert len(inp.point_sets['NODES_REGION_1']) == 75
assert sorted(inp.cell_sets) == ['EALL', 'REGION_1', 'REGION_2']
bdf = measure('a.bdf', 'nastran')
assert sorted(numpy.concatenate(bdf.cell_data['nastran:ref'])) == [1] * 192 + [2] * 192 + [3] * 96 + [4] * 32 + [5] * 96
)";
  ASSERT_EQ(run_python(program), 0) << log_;
  EXPECT_EQ(log_.substr(log_.find("a.vtu")),
            "a.vtu 125 384 0 1000.0\na.vtk 125 384 0 1000.0\na.mesh 125 384 224 1000.0\na.msh 125 384 224 1000.0\n"
            "b.msh2 125 384 224 1000.0\na.inp 125 384 0 1000.0\na.bdf 125 384 224 1000.0\n");
}

TEST_F(Meshio, FilesItWritesAreReadWithTheirRegions) {
  write("a.mesh");
  const std::string program = kMeasure + R"(
mesh = measure('a.mesh', None)
for name, kind in [('c.vtu', 'vtu'), ('c.vtk', 'vtk'), ('d.vtk', 'vtk42'), ('c.mesh', 'medit'), ('c.msh', 'gmsh22')]:
    if kind == 'gmsh22': mesh.cell_data = {'gmsh:physical': mesh.cell_data['medit:ref'], 'gmsh:geometrical': mesh.cell_data['medit:ref']}
    meshio.write(name, mesh, file_format=kind, **({'binary': False} if kind == 'gmsh22' else {}))
meshio.write('e.vtk', mesh, file_format='vtk', binary=False)
meshio.write('e.vtu', mesh, file_format='vtu', binary=False)
meshio.write('f.vtu', mesh, file_format='vtu', compression=None)
meshio.write('g.vtu', mesh, file_format='vtu', compression='lzma')
)";
  ASSERT_EQ(run_python(program), 0) << log_;
  for (const char* name : {"c.vtu", "c.vtk", "d.vtk", "c.mesh", "c.msh", "e.vtk", "e.vtu", "f.vtu", "g.vtu"}) {
    SCOPED_TRACE(name);
    const TetMesh copy = read_mesh(file(name));
    EXPECT_EQ(copy.tets.size(), 384U);
    EXPECT_NEAR(volume_mm3(copy), 1000, 1e-6);
    EXPECT_EQ(std::count(copy.tet_regions.begin(), copy.tet_regions.end(), 1), 192);
    EXPECT_EQ(std::count(copy.tet_regions.begin(), copy.tet_regions.end(), 2), 192);
    EXPECT_EQ(copy.boundary_facets.size(), 224U);
  }
}

TEST_F(OtherPrograms, FenicsxReadsXdmfWithItsTags) {
  if (std::string(SCANTET_PYTHON_WITH_DOLFINX).empty()) GTEST_SKIP() << "no python3 with dolfinx was found";
  write("a.xdmf");
  put_content(file("program.py"), R"(
import numpy
from mpi4py import MPI
from dolfinx.io import XDMFFile
with XDMFFile(MPI.COMM_WORLD, 'a.xdmf', 'r') as file:
    mesh = file.read_mesh(name='mesh')
    mesh.topology.create_entities(2)
    mesh.topology.create_connectivity(2, 3)
    cells = file.read_meshtags(mesh, name='mesh')
    facets = file.read_meshtags(mesh, name='boundary')
assert mesh.geometry.x.shape == (125, 3)
assert dict(zip(*numpy.unique(cells.values, return_counts=True))) == {1: 192, 2: 192}
assert dict(zip(*numpy.unique(facets.values, return_counts=True))) == {3: 96, 4: 32, 5: 96}
middle = mesh.geometry.x[mesh.geometry.dofmap.array.reshape(-1, 4)].mean(axis=1)
assert (middle[cells.find(1), 0] < 1).all() and (middle[cells.find(2), 0] > 1).all()
)");
  EXPECT_EQ(run(std::string("'") + SCANTET_PYTHON_WITH_DOLFINX + "' program.py"), 0) << log_;
}

class CalculiX : public OtherPrograms {
 protected:
  void SetUp() override {
    OtherPrograms::SetUp();
    if (std::string(SCANTET_CCX).empty()) GTEST_SKIP() << "ccx (CalculiX) was not found";
  }
};

/// The numbers on the first line of numbers after a title.
std::vector<double> numbers_after(const std::string& text, const std::string& title) {
  const std::size_t at = text.find(title);
  if (at == std::string::npos) return {};
  std::istringstream lines(text.substr(text.find('\n', at)));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::vector<double> numbers;
    for (double number = 0; words >> number;) numbers.push_back(number);
    if (!numbers.empty()) return numbers;
  }
  return {};
}

TEST_F(CalculiX, SolvesWithPressureOnABoundarySurface) {
  write("mesh.inp");
  std::ostringstream deck;
  deck << "*INCLUDE, INPUT=mesh.inp\n*NSET, NSET=FIXED\n";
  for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
    if (mesh_.vertices[v].x == -4) deck << v + 1 << ",\n";
  }
  deck << "*MATERIAL, NAME=SOFT\n*ELASTIC\n1000., 0.3\n*MATERIAL, NAME=HARD\n*ELASTIC\n5000., 0.3\n"
          "*SOLID SECTION, ELSET=REGION_1, MATERIAL=SOFT\n*SOLID SECTION, ELSET=REGION_2, MATERIAL=HARD\n"
          "*BOUNDARY\nFIXED, 1, 3\n*STEP\n*STATIC\n*DSLOAD\nBOUNDARY_2_0, P, 1.\n"
          "*NODE PRINT, NSET=FIXED, TOTALS=ONLY\nRF\n*EL PRINT, ELSET=EALL, TOTALS=ONLY\nEVOL\n*END STEP\n";
  put_content(file("deck.inp"), deck.str());
  ASSERT_EQ(run(std::string("'") + SCANTET_CCX + "' -i deck"), 0) << log_;
  EXPECT_EQ(log_.find("*ERROR"), std::string::npos) << log_;
  EXPECT_EQ(log_.find("nonpositive jacobian"), std::string::npos) << log_;
  const std::string results = content_of(file("deck.dat"));
  const std::vector<double> volume = numbers_after(results, "total volume for set EALL");
  ASSERT_EQ(volume.size(), 1U) << results;
  EXPECT_NEAR(volume[0], 1000, 1e-3);
  // Pressure 1 on the outside of the +x half pushes as if on its open side, 10 mm x 10 mm, towards -x.
  const std::vector<double> force = numbers_after(results, "total force (fx,fy,fz) for set FIXED");
  ASSERT_EQ(force.size(), 3U) << results;
  EXPECT_NEAR(force[0], 100, 1e-3);
  EXPECT_NEAR(force[1], 0, 1e-3);
  EXPECT_NEAR(force[2], 0, 1e-3);
}

TEST_F(CalculiX, NumbersFitIntoTheTwentyCharactersThatItReads) {
  TetMesh mesh = make_cube(2);
  for (Point& p : mesh.vertices) p = {-1e-5 * (p.x + 0.1 / 3), 1e-7 * p.y / 3, 1.0 / 3 * p.z};
  write_mesh(mesh, file("mesh.inp"));
  std::istringstream lines(content_of(file("mesh.inp")));
  std::string line;
  std::getline(lines, line);
  std::getline(lines, line);
  ASSERT_EQ(line, "*NODE, NSET=NALL");
  for (const Point& p : mesh.vertices) {
    std::getline(lines, line);
    std::istringstream fields(line);
    std::string field;
    std::getline(fields, field, ',');
    for (int axis = 0; axis < 3; ++axis) {
      std::getline(fields, field, ',');
      field.erase(0, 1);
      EXPECT_LE(field.size(), 20U) << field;
      EXPECT_NEAR(std::stod(field), p[axis], 1e-13 * std::abs(p[axis])) << field;
    }
  }
}

}  // namespace
}  // namespace scantet
