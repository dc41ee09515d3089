// Every format says the same of which vertices are on the boundary: those of the boundary facets, whatever the mesh's
// own flags say.
#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <set>
#include <sstream>

#include "io_test_support.h"
#include "scantet/io/mesh_io.h"

namespace scantet {
namespace {

using VertexSet = std::set<std::size_t>;

template <typename Reader>
VertexSet flagged_by_vtk(const std::string& path) {
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkDataArray* const flags = reader->GetOutput()->GetPointData()->GetArray("on_boundary");
  VertexSet found;
  for (vtkIdType v = 0; flags != nullptr && v < flags->GetNumberOfTuples(); ++v) {
    if (flags->GetTuple1(v) != 0) found.insert(static_cast<std::size_t>(v));
  }
  return found;
}

VertexSet flagged_in_medit(const std::string& path) {
  std::istringstream words(content_of(path));
  for (std::string word; words >> word && word != "Vertices";) {
  }
  std::size_t count = 0;
  words >> count;
  VertexSet found;
  for (std::size_t v = 0; v < count; ++v) {
    double x = 0, y = 0, z = 0;
    int reference = 0;
    words >> x >> y >> z >> reference;
    if (reference == 1) found.insert(v);
  }
  return found;
}

VertexSet flagged_in_inp(const std::string& path) {
  std::string text = content_of(path);
  const std::string title = "*NSET, NSET=BOUNDARY\n";
  const std::size_t begin = text.find(title) + title.size();
  text = text.substr(begin, text.find('*', begin) - begin);
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream words(text);
  VertexSet found;
  for (std::size_t node = 0; words >> node;) found.insert(node - 1);
  return found;
}

/// Nodes in blocks of surface entities, of curves and of points.
VertexSet flagged_in_msh(const std::string& path) {
  std::istringstream words(content_of(path));
  for (std::string word; words >> word && word != "$Nodes";) {
  }
  std::size_t blocks = 0, nodes = 0, least = 0, most = 0;
  words >> blocks >> nodes >> least >> most;
  VertexSet found;
  for (std::size_t block = 0; block < blocks; ++block) {
    std::size_t dimension = 0, entity = 0, parametric = 0, count = 0;
    words >> dimension >> entity >> parametric >> count;
    for (std::size_t i = 0; i < count; ++i) {
      std::size_t node = 0;
      words >> node;
      if (dimension <= 2) found.insert(node - 1);
    }
    double coordinate = 0;
    for (std::size_t i = 0; i < 3 * count; ++i) words >> coordinate;
  }
  return found;
}

class BoundaryFlags : public IoTest {
 protected:
  /// What each format says of the mesh.
  std::vector<VertexSet> told(const TetMesh& mesh) const {
    for (const char* name : {"a.vtu", "a.vtk", "a.mesh", "a.inp", "a.msh"}) write_mesh(mesh, file(name));
    return {flagged_by_vtk<vtkXMLUnstructuredGridReader>(file("a.vtu")),
            flagged_by_vtk<vtkUnstructuredGridReader>(file("a.vtk")), flagged_in_medit(file("a.mesh")),
            flagged_in_inp(file("a.inp")), flagged_in_msh(file("a.msh"))};
  }
};

TEST_F(BoundaryFlags, AreTheVerticesOfBoundaryFacetsInEveryFormat) {
  TetMesh mesh = make_cube(4, 1, 2);
  VertexSet expected;
  for (const Triangle& facet : mesh.boundary_facets) expected.insert(facet.begin(), facet.end());
  ASSERT_EQ(expected.size(), 107U);
  EXPECT_EQ(told(mesh), std::vector<VertexSet>(5, expected));
  mesh.strata.assign(mesh.vertices.size(), {0, 2});  // also those inside
  EXPECT_EQ(told(mesh), std::vector<VertexSet>(5, expected)) << "vertices inside are flagged";
  mesh.strata.assign(mesh.vertices.size(), {0, 3});
  EXPECT_EQ(told(mesh), std::vector<VertexSet>(5, expected)) << "no vertex is flagged";
}

TEST_F(BoundaryFlags, WrongOnesChangeNoFile) {
  const TetMesh mesh = make_cube(4, 1, 2);
  TetMesh flagged = mesh;
  flagged.strata.assign(mesh.vertices.size(), {0, 2});
  for (const MeshFormat& format : mesh_formats()) {
    const std::string path = file("a" + format.extension);
    write_mesh(mesh, path);
    const std::string without = content_of_mesh(path);
    write_mesh(flagged, path);
    EXPECT_TRUE(content_of_mesh(path) == without) << format.extension;
    if (!format.can_read) continue;
    EXPECT_EQ(read_mesh(path).strata, mesh.strata);
  }
}

}  // namespace
}  // namespace scantet
