// Tets of ten nodes in mesh files, as other programs find them: each edge's node beside its edge, whatever order the
// format has.
#include <gtest/gtest.h>
#include <vtk_exodusII.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "hdf5_test_support.h"
#include "model_test_support.h"
#include "scantet/base/mesh_order.h"
#include "scantet/io/mesh_io.h"

namespace scantet {
namespace {

constexpr std::size_t kEdges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};

/// Gives each edge a node `bulge` of its length off the middle, those within the boundary's planes in the middle.
void add_edge_nodes(TetMesh& mesh, double bulge) {
  std::map<std::array<VertexId, 2>, VertexId> nodes;
  std::set<std::array<VertexId, 2>> on_boundary;
  for (const Triangle& f : mesh.boundary_facets) {
    for (std::size_t i = 0; i < 3; ++i) {
      on_boundary.insert({std::min(f[i], f[(i + 1) % 3]), std::max(f[i], f[(i + 1) % 3])});
    }
  }
  for (const Tet& tet : mesh.tets) {
    std::array<VertexId, 6> of_tet{};
    for (std::size_t e = 0; e < 6; ++e) {
      const VertexId a = std::min(tet[kEdges[e][0]], tet[kEdges[e][1]]);
      const VertexId b = std::max(tet[kEdges[e][0]], tet[kEdges[e][1]]);
      const auto [at, is_new] = nodes.try_emplace({a, b}, static_cast<VertexId>(mesh.vertices.size()));
      if (is_new) {
        const bool is_outer = on_boundary.contains({a, b});
        const Vec along = mesh.vertices[b] - mesh.vertices[a];
        const Vec off = is_outer ? Vec{} : bulge * Vec{along.y, along.z, along.x};
        mesh.vertices.push_back(lerp(mesh.vertices[a], mesh.vertices[b], 0.5) + off);
        mesh.strata.push_back({0, static_cast<std::uint8_t>(is_outer ? 2 : 3)});
      }
      of_tet[e] = at->second;
    }
    mesh.tet_edge_vertices.push_back(of_tet);
  }
}

class SecondOrderFiles : public IoTest {
 protected:
  void SetUp() override {
    IoTest::SetUp();
    mesh_ = make_cube(2, 1, 2);
    add_edge_nodes(mesh_, 0.02);
  }
  void write(const std::string& name) const { write_mesh(mesh_, file(name)); }
  int run(const std::string& command) const {
    return std::system(
        ("cd '" + folder_.string() + "' && OMP_NUM_THREADS=1 " + command + " > log 2>&1 < /dev/null").c_str());
  }

  TetMesh mesh_;
};

TEST_F(SecondOrderFiles, MeshioFindsEachNodeBesideItsEdge) {
  if (std::string(SCANTET_PYTHON_WITH_MESHIO).empty()) GTEST_SKIP() << "meshio was not found";
  std::ofstream script(file("check.py"));
  script
      << "import meshio, numpy, sys\n"
         "edges = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]\n"
         "for name in sys.argv[1:]:\n"
         "    mesh = meshio.read(name)\n"
         "    tets = numpy.concatenate([c.data for c in mesh.cells if c.type == 'tetra10'])\n"
         "    assert len(tets) == 48, (name, len(tets))\n"
         "    assert len(numpy.unique(tets)) == len(mesh.points), name\n"
         "    p = mesh.points[tets]\n"
         "    for node, (a, b) in enumerate(edges):\n"
         "        off = numpy.linalg.norm(p[:, 4 + node] - (p[:, a] + p[:, b]) / 2, axis=1)\n"
         "        assert (off < 0.03 * numpy.linalg.norm(p[:, a] - p[:, b], axis=1)).all(), (name, node)\n"
         "    volume = numpy.einsum('ij,ij->i', p[:, 1] - p[:, 0], numpy.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 0]))\n"
         "    assert (volume > 0).all() and abs(volume.sum() / 6 - 1000) < 1e-6, (name, volume.sum())\n"
         "    for c in mesh.cells:\n"
         "        if c.type != 'triangle6':\n"
         "            continue\n"
         "        q = mesh.points[c.data]\n"
         "        for node, (a, b) in enumerate([(0, 1), (1, 2), (2, 0)]):\n"
         "            assert abs(q[:, 3 + node] - (q[:, a] + q[:, b]) / 2).max() < 1e-9, (name, node)\n"
         "    if name.endswith('.msh'):\n"
         "        assert sum(len(c.data) for c in mesh.cells if c.type == 'triangle6') == 56, name\n";
  script.close();
  for (const char* name : {"a.vtu", "a.vtk", "a.msh", "a.msh2", "a.inp", "a.bdf"}) write(name);
  std::filesystem::rename(file("a.msh2"), file("b.msh"));
  EXPECT_EQ(run(std::string("'") + SCANTET_PYTHON_WITH_MESHIO + "' check.py a.vtu a.vtk a.msh b.msh a.inp a.bdf"), 0)
      << content_of(file("log"));
}

TEST_F(SecondOrderFiles, GmshFindsTheMeshCoherent) {
  if (std::string(SCANTET_GMSH).empty()) GTEST_SKIP() << "gmsh was not found";
  write("a.msh");
  write("b.msh2");
  for (const char* name : {"a.msh", "b.msh2"}) {
    EXPECT_EQ(run(std::string("'") + SCANTET_GMSH + "' " + name + " -check"), 0) << content_of(file("log"));
    const std::string log = content_of(file("log"));
    EXPECT_EQ(log.find("Error "), std::string::npos) << log;
    EXPECT_EQ(log.find("Warning "), std::string::npos) << log;
  }
}

TEST_F(SecondOrderFiles, ExodusMedAndXdmfHaveTenNodesInTheirOrders) {
  for (const char* name : {"a.exo", "a.med", "a.xdmf"}) write(name);
  int own_reals = sizeof(double);
  int file_reals = 0;
  float version = 0;
  const int id = ex_open(file("a.exo").c_str(), EX_READ, &own_reals, &file_reals, &version);
  ASSERT_GE(id, 0);
  ex_block block{};
  block.id = 1;
  block.type = EX_ELEM_BLOCK;
  EXPECT_EQ(ex_get_block_param(id, &block), 0);
  EXPECT_STREQ(block.topology, "TETRA10");
  EXPECT_EQ(block.num_nodes_per_entry, 10);
  std::vector<int> nodes(static_cast<std::size_t>(10 * block.num_entry));
  EXPECT_EQ(ex_get_conn(id, EX_ELEM_BLOCK, 1, nodes.data(), nullptr, nullptr), 0);
  ex_close(id);
  const auto first = static_cast<std::size_t>(std::find(mesh_.tet_regions.begin(), mesh_.tet_regions.end(), 1) -
                                              mesh_.tet_regions.begin());
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(nodes[i], static_cast<int>(mesh_.tets[first][i]) + 1);
  for (std::size_t e = 0; e < 6; ++e) EXPECT_EQ(nodes[4 + e], static_cast<int>(mesh_.tet_edge_vertices[first][e]) + 1);

  const std::string cells = "/ENS_MAA/mesh/-0000000000000000001-0000000000000000001/MAI/";
  const auto med = numbers_in<int>(file("a.med"), cells + "T10/NOD", H5T_NATIVE_INT);
  ASSERT_EQ(med.size(), 10 * mesh_.tets.size());
  EXPECT_EQ(attribute_in(file("a.med"), cells + "T10", "GEO"), 310);
  EXPECT_EQ(attribute_in(file("a.med"), cells + "TR6", "GEO"), 206);
  // MED has the nodes on 12, 23, 31, 14, 24, 34 of its own corners.
  for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
    const auto node = [&](std::size_t i) {
      return mesh_.vertices[static_cast<std::size_t>(med[i * mesh_.tets.size() + t] - 1)];
    };
    constexpr std::size_t kMed[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    for (std::size_t e = 0; e < 6; ++e) {
      const Point a = node(kMed[e][0]), b = node(kMed[e][1]);
      EXPECT_LT(distance(node(4 + e), lerp(a, b, 0.5)), 0.03 * distance(a, b)) << t << " " << e;
    }
  }
  std::vector<hsize_t> extents;
  numbers_in<int>(file("a.h5"), "/mesh/topology", H5T_NATIVE_INT, &extents);
  EXPECT_EQ(extents, (std::vector<hsize_t>{mesh_.tets.size(), 10}));
  numbers_in<int>(file("a.h5"), "/boundary/topology", H5T_NATIVE_INT, &extents);
  EXPECT_EQ(extents, (std::vector<hsize_t>{mesh_.boundary_facets.size(), 6}));
}

TEST_F(SecondOrderFiles, OurReadersGiveThemBack) {
  for (const char* name : {"a.vtu", "a.vtk", "a.msh", "b.msh2", "a.inp", "a.mesh"}) {
    SCOPED_TRACE(name);
    write(name);
    const TetMesh read = read_mesh(file(name));
    EXPECT_EQ(read.vertices, mesh_.vertices);
    EXPECT_EQ(read.tets, mesh_.tets);
    EXPECT_EQ(read.tet_edge_vertices, mesh_.tet_edge_vertices);
    EXPECT_EQ(read.tet_regions, mesh_.tet_regions);
    EXPECT_EQ(read.boundary_facets, mesh_.boundary_facets);
    for (VertexId v = 0; v < mesh_.vertices.size(); ++v) EXPECT_EQ(read.on_boundary(v), mesh_.on_boundary(v)) << v;
    const TetMesh corners = first_order(read);
    EXPECT_EQ(corners.tets, mesh_.tets);
    EXPECT_EQ(corners.vertices.size(), 27U);
    EXPECT_TRUE(corners.tet_edge_vertices.empty());
    EXPECT_EQ(corners.boundary_facets, mesh_.boundary_facets);
  }
}

TEST_F(SecondOrderFiles, GmshTakesMeditsTetsForItsOwn) {
  if (std::string(SCANTET_GMSH).empty()) GTEST_SKIP() << "gmsh was not found";
  write("a.mesh");
  const std::string gmsh = std::string("'") + SCANTET_GMSH + "' a.mesh -save -format msh22 -o b.msh";
  EXPECT_EQ(run(gmsh), 0) << content_of(file("log"));
  const TetMesh read = read_mesh(file("b.msh"));  // its nodes are numbered anew
  ASSERT_EQ(read.tet_edge_vertices.size(), mesh_.tets.size());
  for (std::size_t t = 0; t < read.tets.size(); ++t) {
    for (std::size_t e = 0; e < 6; ++e) {
      const Point& a = read.vertices[read.tets[t][kEdges[e][0]]];
      const Point& b = read.vertices[read.tets[t][kEdges[e][1]]];
      const Point& node = read.vertices[read.tet_edge_vertices[t][e]];
      EXPECT_LT(distance(node, lerp(a, b, 0.5)), 0.03 * distance(a, b)) << t << " " << e;
    }
  }
}

TEST_F(SecondOrderFiles, NodesOnEdgesOfJunctionsAreOnTheirCurves) {
  write("a.vtu");
  const TetMesh read = read_mesh(file("a.vtu"));
  ASSERT_FALSE(read.curve_edges.empty());
  std::size_t on_curves = 0;
  for (std::size_t t = 0; t < read.tets.size(); ++t) {
    for (std::size_t e = 0; e < 6; ++e) {
      const std::array<VertexId, 2> edge{std::min(read.tets[t][kEdges[e][0]], read.tets[t][kEdges[e][1]]),
                                         std::max(read.tets[t][kEdges[e][0]], read.tets[t][kEdges[e][1]])};
      const bool is_of_curve =
          std::find(read.curve_edges.begin(), read.curve_edges.end(), edge) != read.curve_edges.end();
      EXPECT_EQ(read.strata[read.tet_edge_vertices[t][e]].dimension == 1, is_of_curve);
      on_curves += is_of_curve ? 1 : 0;
    }
  }
  EXPECT_GT(on_curves, 0U);
}

TEST_F(SecondOrderFiles, AFileOfBothOrdersIsRefused) {
  put_content(file("a.msh"),
              "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n11\n1 0 0 0\n2 2 0 0\n3 0 2 0\n4 0 0 2\n5 1 0 0\n"
              "6 1 1 0\n7 0 1 0\n8 0 0 1\n9 0 1 1\n10 1 0 1\n11 0 0 -2\n$EndNodes\n$Elements\n2\n"
              "1 11 2 1 1 1 2 3 4 5 6 7 8 9 10\n2 4 2 1 1 1 3 2 11\n$EndElements\n");
  const Error error = error_of([&] { read_mesh(file("a.msh")); });
  EXPECT_EQ(error.code(), "input.bad_mesh");
  EXPECT_NE(std::string(error.what()).find("1 of its 2 tetrahedra have ten nodes"), std::string::npos) << error.what();
}

/// A linear displacement on the boundary must come out inside, too.
TEST_F(SecondOrderFiles, CalculixPassesThePatchTest) {
  if (std::string(SCANTET_CCX).empty()) GTEST_SKIP() << "ccx (CalculiX) was not found";
  mesh_ = make_cube(2, 1, 2);
  add_edge_nodes(mesh_, 0);  // of curved elements the rule of four points is not exact
  write("mesh.inp");
  const auto displaced = [](const Point& p) {
    return Vec{1e-3 * p.x + 2e-3 * p.y, 5e-4 * p.z - 1e-3 * p.x, 1e-3 * p.y + 3e-3 * (p.z - 100)};
  };
  std::ofstream deck(file("deck.inp"));
  deck.precision(15);
  deck << "*INCLUDE, INPUT=mesh.inp\n*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.3\n*SOLID SECTION, ELSET=EALL, "
          "MATERIAL=M\n*STEP\n*STATIC\n*BOUNDARY\n";
  for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
    if (!mesh_.on_boundary(static_cast<VertexId>(v))) continue;
    const Vec u = displaced(mesh_.vertices[v]);
    for (int axis = 0; axis < 3; ++axis)
      deck << v + 1 << ", " << axis + 1 << ", " << axis + 1 << ", " << u[axis] << '\n';
  }
  deck << "*NODE PRINT, NSET=NALL\nU\n*END STEP\n";
  deck.close();
  ASSERT_EQ(run(std::string("'") + SCANTET_CCX + "' -i deck"), 0) << content_of(file("log"));
  EXPECT_EQ(content_of(file("log")).find("*ERROR"), std::string::npos) << content_of(file("log"));
  EXPECT_EQ(content_of(file("log")).find("nonpositive jacobian"), std::string::npos);
  std::istringstream lines(content_of(file("deck.dat")));
  std::size_t found = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::size_t node = 0;
    Vec u;
    if (!(words >> node >> u.x >> u.y >> u.z) || node == 0 || node > mesh_.vertices.size()) continue;
    ++found;
    EXPECT_LT(length(u - displaced(mesh_.vertices[node - 1])), 1e-7) << node;
  }
  EXPECT_EQ(found, mesh_.vertices.size());
}

}  // namespace
}  // namespace scantet
