// .vtu and .vtk: what VTK reads in our files, and that all the ways VTK has to write a grid are read.
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "io_test_support.h"
#include "scantet/io/mesh_io.h"

namespace scantet {
namespace {

using VtkFiles = IoTest;

template <typename Reader>
void expect_as_written(const TetMesh& mesh, const std::string& path, bool ras) {
  SCOPED_TRACE(path);
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkUnstructuredGrid* const grid = reader->GetOutput();
  ASSERT_EQ(grid->GetNumberOfPoints(), static_cast<vtkIdType>(mesh.vertices.size()));
  ASSERT_EQ(grid->GetNumberOfCells(), static_cast<vtkIdType>(mesh.tets.size()));
  vtkDataArray* const on_boundary = grid->GetPointData()->GetArray("on_boundary");
  ASSERT_NE(on_boundary, nullptr);
  EXPECT_EQ(on_boundary->GetDataType(), VTK_UNSIGNED_CHAR);
  const double sign = ras ? -1 : 1;
  for (vtkIdType v = 0; v < grid->GetNumberOfPoints(); ++v) {
    const Point& p = mesh.vertices[static_cast<std::size_t>(v)];
    EXPECT_EQ(grid->GetPoint(v)[0], sign * p.x);
    EXPECT_EQ(grid->GetPoint(v)[1], sign * p.y);
    EXPECT_EQ(grid->GetPoint(v)[2], p.z);
    EXPECT_EQ(on_boundary->GetTuple1(v), mesh.on_boundary(static_cast<VertexId>(v)) ? 1 : 0);
  }
  vtkDataArray* const region = grid->GetCellData()->GetArray("region");
  ASSERT_NE(region, nullptr);
  EXPECT_EQ(region->GetDataType(), VTK_INT);
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) {
    ASSERT_EQ(grid->GetCellType(i), VTK_TETRA);
    EXPECT_EQ(region->GetTuple1(i), mesh.tet_regions[static_cast<std::size_t>(i)]);
    for (int k = 0; k < 4; ++k) {
      EXPECT_EQ(grid->GetCell(i)->GetPointId(k), mesh.tets[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)]);
    }
  }
}

TEST_F(VtkFiles, VtkReadsOurs) {
  const TetMesh mesh = make_cube(3, 1, 9);
  for (const bool ras : {false, true}) {
    write_mesh(mesh, file("a.vtu"), {ras, "x", "4.1"});
    write_mesh(mesh, file("a.vtk"), {ras, "x", "4.1"});
    expect_as_written<vtkXMLUnstructuredGridReader>(mesh, file("a.vtu"), ras);
    expect_as_written<vtkUnstructuredGridReader>(mesh, file("a.vtk"), ras);
  }
}

TEST_F(VtkFiles, SpaceIsSaidWhereSlicerLooksForIt) {
  const TetMesh mesh = make_cube(1);
  for (const bool ras : {false, true}) {
    write_mesh(mesh, file("a.vtu"), {ras, "x", "4.1"});
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName(file("a.vtu").c_str());
    reader->Update();
    auto* const space = vtkStringArray::SafeDownCast(reader->GetOutput()->GetFieldData()->GetAbstractArray("SPACE"));
    EXPECT_EQ(space != nullptr, ras);
    if (space != nullptr) {
      EXPECT_EQ(space->GetValue(0), "RAS");
    }
    write_mesh(mesh, file("a.vtk"), {ras, "x", "4.1"});
    vtkNew<vtkUnstructuredGridReader> legacy;
    legacy->SetFileName(file("a.vtk").c_str());
    legacy->Update();
    EXPECT_STREQ(legacy->GetHeader(), ras ? "SPACE=RAS; x" : "SPACE=LPS; x");
  }
}

/// The mesh with everything around it that other programs add: other cells, arrays of all kinds, strings.
vtkSmartPointer<vtkUnstructuredGrid> crowded_grid(const TetMesh& mesh) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Point& p : mesh.vertices) points->InsertNextPoint(p.x, p.y, p.z);
  grid->SetPoints(points);
  vtkNew<vtkIdTypeArray> region;
  region->SetName("region");
  vtkNew<vtkFloatArray> reference;
  reference->SetName("medit:ref");
  vtkNew<vtkFloatArray> weights;
  weights->SetName("weights of cells");
  weights->SetNumberOfComponents(3);
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    vtkIdType ids[4];
    std::copy(mesh.tets[i].begin(), mesh.tets[i].end(), ids);
    if (i % 10 == 0) {
      grid->InsertNextCell(VTK_TRIANGLE, 3, ids);
      region->InsertNextValue(-7);
    }
    grid->InsertNextCell(VTK_TETRA, 4, ids);
    region->InsertNextValue(mesh.tet_regions[i]);
  }
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) {
    weights->InsertNextTuple3(static_cast<double>(i), 0.5, -1);
    reference->InsertNextValue(0.5F);  // no region number: must not be looked at where there is a better array
  }
  grid->GetCellData()->AddArray(reference);
  grid->GetCellData()->SetScalars(region);
  grid->GetCellData()->SetVectors(weights);
  vtkNew<vtkDoubleArray> normals;
  normals->SetName("normals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(grid->GetNumberOfPoints());
  normals->Fill(0.25);
  grid->GetPointData()->SetNormals(normals);
  vtkNew<vtkStringArray> words;
  words->SetName("some words");
  words->InsertNextValue("a sentence with spaces\nand lines");
  words->InsertNextValue(std::string(300, 'x'));
  grid->GetFieldData()->AddArray(words);
  vtkNew<vtkStringArray> names;
  names->SetName("region_names");  // as in the output of vtkScantetMesher: not the array of characters that we write
  names->InsertNextValue("bone");
  grid->GetFieldData()->AddArray(names);
  return grid;
}

void expect_mesh(const TetMesh& mesh, const std::string& path, double tolerance_mm) {
  SCOPED_TRACE(path);
  const TetMesh read = read_mesh(path);
  EXPECT_EQ(read.tets, mesh.tets);
  EXPECT_EQ(read.tet_regions, mesh.tet_regions);
  EXPECT_EQ(read.boundary_facets, mesh.boundary_facets);
  ASSERT_EQ(read.vertices.size(), mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    EXPECT_LE(distance(read.vertices[v], mesh.vertices[v]), tolerance_mm);
  }
}

TEST_F(VtkFiles, EveryWayToWriteAVtuIsRead) {
  const TetMesh mesh = make_cube(3, 1, 2);
  const auto grid = crowded_grid(mesh);
  const int appended = vtkXMLWriter::Appended;  // negative: raw instead of base64
  for (const int mode : {int{vtkXMLWriter::Ascii}, int{vtkXMLWriter::Binary}, appended, -appended}) {
    for (const int compressor : {vtkXMLWriter::NONE, vtkXMLWriter::ZLIB, vtkXMLWriter::LZ4, vtkXMLWriter::LZMA}) {
      for (const int header : {vtkXMLWriter::UInt32, vtkXMLWriter::UInt64}) {
        for (const int order : {vtkXMLWriter::LittleEndian, vtkXMLWriter::BigEndian}) {
          const std::string name = "m" + std::to_string(mode) + "c" + std::to_string(compressor) + "h" +
                                   std::to_string(header) + "o" + std::to_string(order) + ".vtu";
          vtkNew<vtkXMLUnstructuredGridWriter> writer;
          writer->SetInputData(grid);
          writer->SetFileName(file(name).c_str());
          writer->SetDataMode(std::abs(mode));
          writer->SetEncodeAppendedData(mode > 0 ? 1 : 0);
          writer->SetCompressorType(compressor);
          writer->SetHeaderType(header);
          writer->SetByteOrder(order);
          writer->SetBlockSize(2048);  // several blocks an array
          ASSERT_EQ(writer->Write(), 1);
          expect_mesh(mesh, file(name), mode == vtkXMLWriter::Ascii ? 1e-9 : 0);
        }
      }
    }
  }
}

TEST_F(VtkFiles, EveryWayToWriteALegacyFileIsRead) {
  const TetMesh mesh = make_cube(3, 1, 2);
  const auto grid = crowded_grid(mesh);
  for (const int version : {42, 51}) {
    for (const int type : {VTK_ASCII, VTK_BINARY}) {
      const std::string name = "v" + std::to_string(version) + "t" + std::to_string(type) + ".vtk";
      vtkNew<vtkUnstructuredGridWriter> writer;
      writer->SetInputData(grid);
      writer->SetFileName(file(name).c_str());
      writer->SetFileVersion(version);
      writer->SetFileType(type);
      ASSERT_EQ(writer->Write(), 1);
      expect_mesh(mesh, file(name), type == VTK_ASCII ? 1e-3 : 0);  // six digits
    }
  }
}

TEST_F(VtkFiles, PiecesOfAVtuBecomeOneMesh) {
  const std::string piece =
      "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" "
      "format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells><DataArray type=\"Int32\" "
      "Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray><DataArray type=\"Int32\" Name=\"offsets\" "
      "format=\"ascii\">4</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">10</DataArray></Cells>"
      "</Piece>";
  put_content(file("a.vtu"),
              "<?xml version=\"1.0\"?><VTKFile type=\"UnstructuredGrid\"><!-- > < --><UnstructuredGrid>" + piece +
                  piece + "</UnstructuredGrid></VTKFile>");
  const TetMesh mesh = read_mesh(file("a.vtu"));
  EXPECT_EQ(mesh.tets, (std::vector<Tet>{{0, 1, 2, 3}, {4, 5, 6, 7}}));
  EXPECT_EQ(mesh.tet_regions, (std::vector<Region>{1, 1}));
}

}  // namespace
}  // namespace scantet
