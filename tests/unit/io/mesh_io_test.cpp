#include "scantet/io/mesh_io.h"

#include <gtest/gtest.h>

#include "io_test_support.h"

namespace scantet {
namespace {

std::vector<std::string> extensions(bool MeshFormat::*able) {
  std::vector<std::string> list;
  for (const MeshFormat& format : mesh_formats()) {
    if (format.*able) list.push_back(format.extension);
  }
  return list;
}

void expect_equal(const TetMesh& a, const TetMesh& b) {
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.tets, b.tets);
  EXPECT_EQ(a.tet_regions, b.tet_regions);
  EXPECT_EQ(a.boundary_facets, b.boundary_facets);
  EXPECT_EQ(a.facet_regions, b.facet_regions);
  EXPECT_EQ(a.strata, b.strata);
}

using MeshIo = IoTest;

TEST_F(MeshIo, EveryReadableFormatGivesBackTheSameMesh) {
  const TetMesh mesh = make_cube(4, 1, 7);
  ASSERT_TRUE(all_positive(mesh));
  for (const std::string& extension : extensions(&MeshFormat::can_read)) {
    SCOPED_TRACE(extension);
    for (const bool ras : {false, true}) {
      MeshWriteOptions options;
      options.ras = ras;
      options.provenance = "test\nof round trips";
      write_mesh(mesh, file("mesh" + extension), options);
      expect_equal(read_mesh(file("mesh" + extension)), mesh);
    }
  }
  EXPECT_EQ(files_in_folder(), extensions(&MeshFormat::can_read).size());  // and no temporary file
}

TEST_F(MeshIo, HowAMeshWasMadeIsReadWholeWithItsQuotes) {
  MeshWriteOptions options;
  options.provenance = "scantet 1.2.3 mesh a.nrrd --size \"4 + 1\" --alpha 1";
  for (const std::string& extension : extensions(&MeshFormat::can_read)) {
    const std::string path = file("made" + extension);
    write_mesh(make_cube(1), path, options);
    EXPECT_EQ(read_provenance(path), options.provenance) << extension;
    write_mesh(make_cube(1), path);
    EXPECT_EQ(read_provenance(path), "") << extension;
    EXPECT_EQ(error_of([&] { read_provenance(file("absent" + extension)); }).code(), "input.cannot_open") << extension;
  }
}

TEST_F(MeshIo, GmshVersionIsAnOption) {
  const TetMesh mesh = make_cube(2, 2, 1);
  MeshWriteOptions options;
  options.gmsh_version = "2.2";
  write_mesh(mesh, file("a.msh"), options);
  write_mesh(mesh, file("b.msh2"));
  EXPECT_EQ(content_of(file("a.msh")), content_of(file("b.msh2")));
  EXPECT_EQ(content_of(file("a.msh")).substr(0, 19), "$MeshFormat\n2.2 0 8");
  expect_equal(read_mesh(file("a.msh")), mesh);
  options.gmsh_version = "3.0";
  EXPECT_EQ(error_of([&] { write_mesh(mesh, file("c.msh"), options); }).code(), "usage.gmsh_version");
}

TEST_F(MeshIo, RegionsThatAreNotPositiveSurviveInFormatsWithNamesOrArrays) {
  const TetMesh mesh = make_cube(2, -3, 5);
  for (const std::string& extension : extensions(&MeshFormat::can_read)) {
    SCOPED_TRACE(extension);
    write_mesh(mesh, file("mesh" + extension));
    expect_equal(read_mesh(file("mesh" + extension)), mesh);
  }
}

TEST_F(MeshIo, TheSameMeshGivesTheSameBytes) {
  const TetMesh mesh = make_cube(5, 1, 2);
  for (const std::string& extension : extensions(&MeshFormat::can_write)) {
    SCOPED_TRACE(extension);
    write_mesh(mesh, file("a" + extension), {false, "scantet test", "4.1"});
    const std::string first = content_of_mesh(file("a" + extension));
    ASSERT_FALSE(first.empty());
    write_mesh(mesh, file("a" + extension), {false, "scantet test", "4.1"});
    EXPECT_TRUE(content_of_mesh(file("a" + extension)) == first);
  }
}

TEST_F(MeshIo, ProvenanceAndSpaceAreRecorded) {
  const TetMesh mesh = make_cube(1);
  for (const std::string& extension : extensions(&MeshFormat::can_write)) {
    if (extension == ".vtu" || extension == ".mesh-complete") continue;  // compressed; other programs look at it
    SCOPED_TRACE(extension);
    write_mesh(mesh, file("a" + extension), {true, "scantet 9.8.7", "4.1"});
    EXPECT_NE(content_of_mesh(file("a" + extension)).find("SPACE=RAS; scantet 9.8.7"), std::string::npos);
  }
}

TEST_F(MeshIo, ExtensionsMayBeUpperCase) {
  const TetMesh mesh = make_cube(1);
  write_mesh(mesh, file("UPPER.VTU"));
  write_mesh(mesh, file("Mixed.Mesh"));
  expect_equal(read_mesh(file("UPPER.VTU")), mesh);
  expect_equal(read_mesh(file("Mixed.Mesh")), mesh);
}

TEST_F(MeshIo, UnknownExtensionsAreRefusedWithAListOfKnownOnes) {
  const TetMesh mesh = make_cube(1);
  for (const char* name : {"mesh.xyz", "mesh", "folder.vtu/mesh", ""}) {
    SCOPED_TRACE(name);
    const Error writing = error_of([&] { write_mesh(mesh, name); });
    EXPECT_EQ(writing.code(), "usage.format");
    EXPECT_EQ(writing.fault(), Fault::usage);
    EXPECT_EQ(
        writing.remedy(),
        "use one of .vtu .vtk .msh .msh2 .mesh .inp .feb .bdf .e .exo .med .xdmf .vtm .elmer .mesh-complete .stls "
        ".stl .ply");
    EXPECT_EQ(error_of([&] { read_mesh(name); }).code(), "usage.format");
  }
  EXPECT_EQ(error_of([&] { read_mesh(file("only_written.stl")); }).code(), "usage.format");
}

TEST_F(MeshIo, BrokenMeshesAreNotWritten) {
  const auto code_for = [&](const auto& damage) {
    TetMesh mesh = make_cube(1);
    damage(mesh);
    return error_of([&] { write_mesh(mesh, file("mesh.mesh")); }).code();
  };
  EXPECT_EQ(code_for([](TetMesh& m) { m.tets.clear(); }), "mesh.inconsistent");
  EXPECT_EQ(code_for([](TetMesh& m) { m.tet_regions.pop_back(); }), "mesh.inconsistent");
  EXPECT_EQ(code_for([](TetMesh& m) { m.tets[0][0] = 1000; }), "mesh.inconsistent");
  EXPECT_EQ(code_for([](TetMesh& m) { m.boundary_facets[0][0] = 1000; }), "mesh.inconsistent");
  EXPECT_EQ(code_for([](TetMesh& m) { m.vertices[0].x = std::nan(""); }), "mesh.inconsistent");
  EXPECT_EQ(code_for([](TetMesh& m) { m.strata.clear(); }), "mesh.inconsistent");
  EXPECT_EQ(files_in_folder(), 0U);
}

TEST_F(MeshIo, NegativeTetsAreKeptAndTheirFacetsStillPointOutwards) {
  TetMesh mesh = make_cube(2);
  for (Tet& tet : mesh.tets) std::swap(tet[0], tet[1]);
  const auto facets = mesh.boundary_facets;
  for (const std::string& extension : extensions(&MeshFormat::can_read)) {
    SCOPED_TRACE(extension);
    write_mesh(mesh, file("mesh" + extension));
    const TetMesh back = read_mesh(file("mesh" + extension));
    EXPECT_EQ(back.tets, mesh.tets);
    EXPECT_NEAR(volume_mm3(back), -1000, 1e-9);
    EXPECT_EQ(back.boundary_facets, facets);
  }
}

TEST_F(MeshIo, OtherCellsAndUnusedVerticesAreLeftOut) {
  put_content(file("a.mesh"),
              "MeshVersionFormatted 2 # a comment\n Dimension\n3\nVertices 6\n0 0 0 0\n9 9 9 0\n1 0 0 0\n0 1 0 0\n"
              "0 0 1 0\n8 8 8 0\nCorners 1\n2\nEdges 1\n1 3 4\nNormals 1\n0.5 -1e3 0\nTriangles 1\n1 3 4 2\n"
              "Tetrahedra 1\n1 3 4 5 12\nEnd\n");
  const TetMesh mesh = read_mesh(file("a.mesh"));
  EXPECT_EQ(mesh.vertices, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(mesh.tets, (std::vector<Tet>{{0, 1, 2, 3}}));
  EXPECT_EQ(mesh.tet_regions, (std::vector<Region>{12}));
  EXPECT_EQ(mesh.boundary_facets.size(), 4U);
}

// A tet, a triangle and a wedge, whose six corners are those of the tet and two more.
TEST_F(MeshIo, CellsOfThreeDimensionsThatAreLeftOutAreCounted) {
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 1\n0 1 1\n";
  put_content(file("a.mesh"),
              "MeshVersionFormatted 2\nDimension 3\nVertices 6\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n1 0 1 0\n0 1 1 0\n"
              "Triangles 1\n1 2 3 0\nPrisms 1\n1 2 3 4 5 6 0\nTetrahedra 1\n1 2 3 4 1\nEnd\n");
  put_content(file("a.msh"),
              "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 0 1\n6 0 1 1\n"
              "$EndNodes\n$Elements\n3\n1 2 0 1 2 3\n2 6 0 1 2 3 4 5 6\n3 4 0 1 2 3 4\n$EndElements\n");
  put_content(file("b.msh"),
              "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 6 1 6\n3 1 0 6\n1\n2\n3\n4\n5\n6\n" + points +
                  "$EndNodes\n$Elements\n3 3 1 3\n2 1 2 1\n1 1 2 3\n3 1 6 1\n2 1 2 3 4 5 6\n3 1 4 1\n3 1 2 3 4\n"
                  "$EndElements\n");
  put_content(file("a.vtk"), "# vtk DataFile Version 4.2\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 double\n" +
                                 points + "CELLS 3 16\n3 0 1 2\n6 0 1 2 3 4 5\n4 0 1 2 3\nCELL_TYPES 3\n5\n13\n10\n");
  for (const char* name : {"a.mesh", "a.msh", "b.msh", "a.vtk"}) {
    const TetMesh mesh = read_mesh(file(name));
    EXPECT_EQ(mesh.tets.size(), 1U) << name;
    EXPECT_EQ(mesh.other_solids, 1U) << name;
  }
  write_mesh(read_mesh(file("a.vtk")), file("c.vtk"), {});
  EXPECT_EQ(read_mesh(file("c.vtk")).other_solids, 0U);
}

TEST_F(MeshIo, TetsWithoutReferenceGetTheNextFreeNumber) {
  const std::string vertices =
      "MeshVersionFormatted 1\nDimension 3\nVertices 5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n1 1 1 0\n";
  put_content(file("none.mesh"), vertices + "Tetrahedra 2\n1 2 3 4 0\n2 3 4 5 0\nEnd\n");
  EXPECT_EQ(read_mesh(file("none.mesh")).tet_regions, (std::vector<Region>{1, 1}));
  put_content(file("some.mesh"), vertices + "Tetrahedra 2\n1 2 3 4 0\n2 3 4 5 6\nEnd\n");
  const TetMesh some = read_mesh(file("some.mesh"));
  EXPECT_EQ(some.tet_regions, (std::vector<Region>{7, 6}));
  EXPECT_EQ(some.boundary_facets.size(), 7U);  // six outside, one between
}

TEST_F(MeshIo, GmshTagsMayHaveGapsAndAnyOrder) {
  put_content(
      file("gaps.msh"),
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n40 0 0 1\n1000000000000 0 0 0\n30 0 1 0\n20 1 0 0\n"
      "$EndNodes\n$Elements\n3\n1 15 2 0 1 20\n2 4 3 0 1 9 20 30 40 1000000000000\n3 2 0 20 30 40\n$EndElements\n");
  const TetMesh mesh = read_mesh(file("gaps.msh"));
  EXPECT_EQ(mesh.vertices, (std::vector<Point>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}));
  EXPECT_EQ(mesh.tets.size(), 1U);
  EXPECT_EQ(mesh.tet_regions, (std::vector<Region>{1}));
}

}  // namespace
}  // namespace scantet
