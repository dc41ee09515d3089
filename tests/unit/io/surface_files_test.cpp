// .stl and .ply, read back by VTK.
#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>

#include "io_test_support.h"
#include "scantet/io/mesh_io.h"

namespace scantet {
namespace {

using SurfaceFiles = IoTest;

/// Volume enclosed by triangles that point outwards.
double enclosed_mm3(vtkPolyData* surface) {
  double sum = 0;
  for (vtkIdType i = 0; i < surface->GetNumberOfCells(); ++i) {
    double p[3][3];
    for (int k = 0; k < 3; ++k) surface->GetPoint(surface->GetCell(i)->GetPointId(k), p[k]);
    sum += dot({p[0][0], p[0][1], p[0][2]}, cross({p[1][0], p[1][1], p[1][2]}, {p[2][0], p[2][1], p[2][2]})) / 6;
  }
  return sum;
}

template <typename Reader>
void expect_surface(const TetMesh& mesh, const std::string& path, bool ras) {
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData* const surface = reader->GetOutput();
  ASSERT_EQ(surface->GetNumberOfCells(), static_cast<vtkIdType>(mesh.boundary_facets.size()));
  // A cube of 4³ cells has 98 vertices on its outside and 125 in all: inner ones are not written.
  EXPECT_EQ(surface->GetNumberOfPoints(), 98);
  EXPECT_NEAR(enclosed_mm3(surface), 1000, 0.01);  // single precision
  double box[6];
  surface->GetBounds(box);
  EXPECT_NEAR(box[0], ras ? -6 : -4, 1e-4);
  EXPECT_NEAR(box[1], ras ? 4 : 6, 1e-4);
  EXPECT_NEAR(box[2], ras ? -10 : 0, 1e-4);
  EXPECT_NEAR(box[4], 100, 1e-4);
}

TEST_F(SurfaceFiles, HoldTheBoundaryPointingOutwards) {
  const TetMesh mesh = make_cube(4);
  for (const bool ras : {false, true}) {
    write_mesh(mesh, file("a.stl"), {ras, "x", "4.1"});
    write_mesh(mesh, file("a.ply"), {ras, "x", "4.1"});
    expect_surface<vtkSTLReader>(mesh, file("a.stl"), ras);
    expect_surface<vtkPLYReader>(mesh, file("a.ply"), ras);
  }
}

TEST_F(SurfaceFiles, HoldInterfacesBetweenRegionsOnce) {
  const TetMesh mesh = make_cube(4, 1, 2);
  write_mesh(mesh, file("a.stl"));
  vtkNew<vtkSTLReader> reader;
  reader->SetFileName(file("a.stl").c_str());
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfCells(), 6 * 32 + 32);
}

TEST_F(SurfaceFiles, LongProvenanceDoesNotSpoilTheStlHeader) {
  write_mesh(make_cube(1), file("a.stl"), {false, std::string(1000, 'p'), "4.1"});
  EXPECT_EQ(content_of(file("a.stl")).size(), 84U + 50 * 12);
  EXPECT_EQ(content_of(file("a.stl")).substr(0, 12), "SPACE=LPS; p");
}

}  // namespace
}  // namespace scantet
