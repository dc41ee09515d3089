// Our measures beside those of Verdict, VTK's library of mesh quality, on the same tets: of a mesh, and of slivers.
// docs/vtk.md has the table of definitions that is held here.
#include <gtest/gtest.h>
#include <vtkMeshQuality.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkTetra.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "scantet/quality/measures.h"
#include "unit/quality/grid_mesh.h"

namespace scantet {
namespace {

using Corners = std::array<Point, 4>;

/// Of a grid with its vertices moved about, then random ones that are ever flatter, down to a millionth.
std::vector<Corners> make_tets() {
  std::vector<Corners> tets;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shift(-0.25, 0.25);
  TetMesh mesh = test::grid_mesh(6);
  for (Point& p : mesh.vertices) p = p + Vec{shift(random), shift(random), shift(random)};
  for (const Tet& t : mesh.tets) {
    tets.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]});
  }
  std::uniform_real_distribution<double> coordinate(-10, 10);
  for (int i = 0; i < 1000; ++i) {
    Corners p;
    const double squeeze = std::pow(10, -6.0 * i / 1000);
    for (Point& corner : p) corner = {coordinate(random), coordinate(random), squeeze * coordinate(random)};
    if (orientation_mm3(p[0], p[1], p[2], p[3]) < 0) std::swap(p[0], p[1]);
    tets.push_back(p);
  }
  return tets;
}

class Verdict : public testing::Test {
 protected:
  /// Calls it for each tet, as we have measured it and as VTK has it.
  template <class Check>
  static void for_each_tet(const Check& check) {
    vtkNew<vtkTetra> cell;
    cell->GetPoints()->SetDataTypeToDouble();
    cell->GetPoints()->SetNumberOfPoints(4);
    for (const Corners& p : make_tets()) {
      for (std::size_t i = 0; i < 4; ++i) {
        cell->GetPoints()->SetPoint(static_cast<vtkIdType>(i), p[i].x, p[i].y, p[i].z);
      }
      const TetMeasures ours = measure_tet(p[0], p[1], p[2], p[3]);
      ASSERT_GT(ours.volume_mm3, 0);
      check(ours, cell.Get());
      if (testing::Test::HasFailure()) FAIL() << "scaled Jacobian " << ours.scaled_jacobian;
    }
  }
  static void expect_same(double ours, double theirs, double share) { EXPECT_NEAR(ours / theirs, 1, share); }
};

TEST_F(Verdict, HasOurVolumesScaledJacobiansAndEdges) {
  for_each_tet([](const TetMeasures& ours, vtkCell* cell) {
    const auto [shortest, longest] = std::minmax_element(ours.edge_mm.begin(), ours.edge_mm.end());
    expect_same(ours.volume_mm3, vtkMeshQuality::TetVolume(cell), 1e-8);
    expect_same(6 * ours.volume_mm3, vtkMeshQuality::TetJacobian(cell), 1e-8);
    expect_same(ours.scaled_jacobian, vtkMeshQuality::TetScaledJacobian(cell), 1e-8);
    expect_same(*longest / *shortest, vtkMeshQuality::TetEdgeRatio(cell), 1e-12);
  });
}

// VTK 9.1 takes angles between the normals of faces of which two point in and two out, and so at the edges 02 and 13
// what is left of 180°. It goes by cosines, which lose half of the digits near 0°.
TEST_F(Verdict, TakesTwoOfOurDihedralAnglesFromTheOtherSide) {
  bool differs = false;
  for_each_tet([&](const TetMeasures& ours, vtkCell* cell) {
    std::array<double, 6> angles = ours.dihedral_deg;
    const double smallest = *std::min_element(angles.begin(), angles.end());
    for (const std::size_t edge : {1, 4}) angles[edge] = 180 - angles[edge];
    const double theirs = vtkMeshQuality::TetMinAngle(cell);
    EXPECT_NEAR(*std::min_element(angles.begin(), angles.end()), theirs, 1e-5);
    differs = differs || smallest < theirs - 1;
  });
  EXPECT_TRUE(differs) << "VTK's measure has become the smallest dihedral angle: docs/vtk.md says otherwise";
}

// Ours is inradius / circumradius, theirs the inverse of that, 1 for the regular tet.
TEST_F(Verdict, HasOurInverseAspectAsRadiusRatioAndAspectBeta) {
  for_each_tet([](const TetMeasures& ours, vtkCell* cell) {
    expect_same(1 / (3 * ours.inverse_aspect), vtkMeshQuality::TetRadiusRatio(cell), 1e-7);
    expect_same(1 / (3 * ours.inverse_aspect), vtkMeshQuality::TetAspectBeta(cell), 1e-7);
  });
}

// Their aspect ratio is longest edge / inradius, that of gamma the cube of the edges' root mean square / volume, each 1
// for the regular tet.
TEST_F(Verdict, HasAspectRatiosThatFollowFromOurMeasures) {
  for_each_tet([](const TetMeasures& ours, vtkCell* cell) {
    const double inradius_mm = ours.inverse_aspect * ours.circumradius_mm;
    const double longest = *std::max_element(ours.edge_mm.begin(), ours.edge_mm.end());
    expect_same(longest / inradius_mm / (2 * std::sqrt(6.0)), vtkMeshQuality::TetAspectRatio(cell), 1e-7);
    double squares = 0;
    for (const double edge : ours.edge_mm) squares += edge * edge;
    const double gamma = std::pow(squares / 6, 1.5) / (6 * std::sqrt(2.0) * ours.volume_mm3);
    expect_same(gamma, vtkMeshQuality::TetAspectGamma(cell), 1e-7);
  });
}

}  // namespace
}  // namespace scantet
