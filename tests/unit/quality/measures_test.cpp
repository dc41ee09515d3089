#include "scantet/quality/measures.h"

#include <gtest/gtest.h>
#include <vtkMeshQuality.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkTetra.h>

#include <numeric>
#include <random>

namespace scantet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::array<double, 6> sorted(std::array<double, 6> v) {
  std::sort(v.begin(), v.end());
  return v;
}

void expect_near(const std::array<double, 6>& actual, const std::array<double, 6>& expected, double tolerance) {
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(actual[i], expected[i], tolerance) << i;
}

TEST(Measures, RegularTet) {
  const TetMeasures m = measure_tet({1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1});
  EXPECT_NEAR(std::abs(m.volume_mm3), 8.0 / 3, 1e-14);
  EXPECT_NEAR(m.circumradius_mm, std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(m.radius_edge, std::sqrt(6.0) / 4, 1e-14);
  EXPECT_NEAR(m.inverse_aspect, 1.0 / 3, 1e-14);
  EXPECT_NEAR(std::abs(m.scaled_jacobian), 1, 1e-14);
  EXPECT_NEAR(m.min_height_mm, 4 / std::sqrt(3.0), 1e-14);
  for (double edge : m.edge_mm) EXPECT_NEAR(edge, std::sqrt(8.0), 1e-14);
  for (double angle : m.dihedral_deg) EXPECT_NEAR(angle, std::acos(1.0 / 3) * 180 / M_PI, 1e-12);
}

TEST(Measures, StiffnessRatioIsOneOfTheRegularTetAndAllItsSizes) {
  for (const double size : {1.0, 0.01, 1e4}) {
    EXPECT_NEAR(stiffness_ratio({size, size, size}, {-size, size, -size}, {size, -size, -size}, {-size, -size, size}),
                1, 1e-12);
  }
}

// The stiffness matrix of the corner of a unit cube is (3, -1, -1, -1; -1, 1, 0, 0; -1, 0, 1, 0; -1, 0, 0, 1) / 6 with
// the largest eigenvalue 4/6, that of a regular tet of its volume (6 √2 / 6)^(1/3) / (3 √2).
TEST(Measures, StiffnessRatioOfTheCornerOfACube) {
  const double regular = std::cbrt(std::sqrt(2.0)) / (3 * std::sqrt(2.0));
  EXPECT_NEAR(stiffness_ratio({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 4.0 / 6 / regular, 1e-12);
  EXPECT_NEAR(stiffness_ratio({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}), 4.0 / 6 / regular, 1e-12) << "turned over";
}

// Held against the power method on the 4 × 4 matrix.
TEST(Measures, StiffnessRatioIsThatOfTheLargestEigenvalue) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (int i = 0; i < 200; ++i) {
    std::array<Point, 4> p;
    for (Point& point : p) point = {coordinate(random), coordinate(random), coordinate(random)};
    const double size = dot(p[1] - p[0], cross(p[2] - p[0], p[3] - p[0]));
    std::array<Vec, 4> gradient;
    for (std::size_t k = 0; k < 4; ++k) {
      const Point& a = p[(k + 1) % 4];
      const Vec normal = cross(p[(k + 2) % 4] - a, p[(k + 3) % 4] - a);
      gradient[k] = (1 / dot(normal, p[k] - a)) * normal;  // 1 at its corner, 0 at the others
    }
    std::array<double, 4> x{1, 0.3, -0.2, -0.7};
    double eigenvalue = 0;
    for (int step = 0; step < 3000; ++step) {
      std::array<double, 4> y{};
      for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t l = 0; l < 4; ++l) y[k] += std::abs(size) / 6 * dot(gradient[k], gradient[l]) * x[l];
      }
      eigenvalue = std::sqrt(std::inner_product(y.begin(), y.end(), y.begin(), 0.0));
      for (std::size_t k = 0; k < 4; ++k) x[k] = y[k] / eigenvalue;
    }
    const double regular = std::cbrt(std::sqrt(2.0) * std::abs(size)) / (3 * std::sqrt(2.0));
    EXPECT_NEAR(stiffness_ratio(p[0], p[1], p[2], p[3]) / (eigenvalue / regular), 1, 1e-6);
  }
}

TEST(Measures, StiffnessRatioOfAFlatTetIsInfinite) {
  EXPECT_EQ(stiffness_ratio({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}), kInfinity);
  EXPECT_EQ(stiffness_ratio({1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}), kInfinity);
  const double large = 1e60;
  EXPECT_NEAR(stiffness_ratio({0, 0, 0}, {large, 0, 0}, {0, large, 0}, {0, 0, large}),
              stiffness_ratio({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1e-12);
}

TEST(Measures, CornerOfACube) {
  const TetMeasures m = measure_tet({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  EXPECT_NEAR(m.volume_mm3, 1.0 / 6, 1e-15);
  EXPECT_NEAR(m.circumradius_mm, std::sqrt(3.0) / 2, 1e-15);
  const double slope = std::atan(std::sqrt(2.0)) * 180 / M_PI;
  expect_near(m.dihedral_deg, {90, 90, 90, slope, slope, slope}, 1e-12);
  const double inradius = 1 / (3 + std::sqrt(3.0));
  EXPECT_NEAR(m.inverse_aspect, inradius / m.circumradius_mm, 1e-15);
  EXPECT_NEAR(m.scaled_jacobian, std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(m.min_height_mm, 1 / std::sqrt(3.0), 1e-15);
}

// The tet of the body-centred cubic lattice: two cube centres and an edge between them.
TEST(Measures, LatticeTet) {
  const TetMeasures m = measure_tet({0, 0, 0}, {1, 0, 0}, {0.5, 0.5, 0.5}, {0.5, -0.5, 0.5});
  EXPECT_NEAR(m.circumradius_mm, std::sqrt(5.0) / 4, 1e-15);
  expect_near(sorted(m.dihedral_deg), {60, 60, 60, 60, 90, 90}, 1e-12);
}

TEST(Measures, OrderOfCornersOnlyTurnsTheSignOfTheVolume) {
  const std::array<Point, 4> p{Point{0, 0.1, 3}, {2, 0.3, 0}, {0.4, 2, 1}, {1, 1, 7}};
  const TetMeasures reference = measure_tet(p[0], p[1], p[2], p[3]);
  std::array<std::size_t, 4> order{0, 1, 2, 3};
  do {
    const TetMeasures m = measure_tet(p[order[0]], p[order[1]], p[order[2]], p[order[3]]);
    EXPECT_NEAR(std::abs(m.volume_mm3), std::abs(reference.volume_mm3), 1e-12);
    EXPECT_NEAR(m.circumradius_mm, reference.circumradius_mm, 1e-12);
    for (const Point& corner : p) EXPECT_NEAR(distance(m.circumcentre, corner), m.circumradius_mm, 1e-12);
    EXPECT_NEAR(m.inverse_aspect, reference.inverse_aspect, 1e-12);
    EXPECT_NEAR(std::abs(m.scaled_jacobian), std::abs(reference.scaled_jacobian), 1e-12);
    EXPECT_EQ(m.scaled_jacobian > 0, m.volume_mm3 > 0);
    EXPECT_NEAR(m.min_height_mm, reference.min_height_mm, 1e-12);
    expect_near(sorted(m.dihedral_deg), sorted(reference.dihedral_deg), 1e-11);
    expect_near(sorted(m.edge_mm), sorted(reference.edge_mm), 1e-12);
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_GT(measure_tet(p[0], p[1], p[2], p[3]).volume_mm3 * measure_tet(p[1], p[2], p[0], p[3]).volume_mm3, 0);
  EXPECT_LT(measure_tet(p[0], p[1], p[2], p[3]).volume_mm3 * measure_tet(p[1], p[0], p[2], p[3]).volume_mm3, 0);
}

// The edges of kTetEdges that meet three dihedral angles at a corner: their sum minus 180° is the solid angle,
// positive.
TEST(Measures, RandomTetsObeyTheLawsOfTets) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-10, 10);
  const auto point = [&] { return Point{coordinate(random), coordinate(random), coordinate(random)}; };
  for (int i = 0; i < 1000; ++i) {
    const std::array<Point, 4> p{point(), point(), point(), point()};
    const TetMeasures m = measure_tet(p[0], p[1], p[2], p[3]);
    EXPECT_GT(m.inverse_aspect, 0);
    EXPECT_LE(m.inverse_aspect, 1.0 / 3 + 1e-12);
    EXPECT_GE(m.radius_edge, std::sqrt(6.0) / 4 - 1e-12);
    EXPECT_GE(m.circumradius_mm * 2, *std::max_element(m.edge_mm.begin(), m.edge_mm.end()) * (1 - 1e-9));
    for (int corner = 0; corner < 4; ++corner) {
      double sum = 0;
      for (std::size_t e = 0; e < 6; ++e) {
        if (kTetEdges[e][0] == corner || kTetEdges[e][1] == corner) sum += m.dihedral_deg[e];
      }
      EXPECT_GT(sum, 180 - 1e-9);
    }
    const double sum = std::accumulate(m.dihedral_deg.begin(), m.dihedral_deg.end(), 0.0);
    EXPECT_GT(sum, 360);
    EXPECT_LT(sum, 540);
  }
}

// A corner's distance from the plane of the others, measured along that plane's normal.
TEST(Measures, ScaledJacobianIsVtksAndHeightIsADistance) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> coordinate(-10, 10);
  std::uniform_real_distribution<double> flatness(-6, 0);
  vtkNew<vtkTetra> tetra;
  tetra->GetPoints()->SetDataTypeToDouble();
  tetra->GetPoints()->SetNumberOfPoints(4);
  for (int i = 0; i < 1000; ++i) {
    const double squeeze = std::pow(10, flatness(random));
    std::array<Point, 4> p;
    for (std::size_t k = 0; k < 4; ++k) {
      p[k] = {coordinate(random), coordinate(random), squeeze * coordinate(random)};
      tetra->GetPoints()->SetPoint(static_cast<vtkIdType>(k), p[k].x, p[k].y, p[k].z);
    }
    const TetMeasures m = measure_tet(p[0], p[1], p[2], p[3]);
    EXPECT_NEAR(m.scaled_jacobian, vtkMeshQuality::TetScaledJacobian(tetra), 1e-12);
    double least = kInfinity;
    for (std::size_t k = 0; k < 4; ++k) {
      const Point& foot = p[(k + 1) % 4];
      const Vec normal = cross(p[(k + 2) % 4] - foot, p[(k + 3) % 4] - foot);
      least = std::min(least, std::abs(dot(p[k] - foot, normal)) / length(normal));
    }
    EXPECT_NEAR(m.min_height_mm / least, 1, 1e-6);
  }
}

TEST(Measures, FlatTetsHaveNoNan) {
  const std::array<std::array<Point, 4>, 4> flats{{
      {Point{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}},  // a square
      {Point{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},  // a line
      {Point{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}},  // a corner twice
      {Point{5, 5, 5}, {5, 5, 5}, {5, 5, 5}, {5, 5, 5}},  // a point
  }};
  for (const auto& p : flats) {
    const TetMeasures m = measure_tet(p[0], p[1], p[2], p[3]);
    EXPECT_EQ(m.volume_mm3, 0);
    EXPECT_EQ(m.inverse_aspect, 0);
    EXPECT_EQ(m.scaled_jacobian, 0);
    EXPECT_EQ(m.min_height_mm, 0);
    EXPECT_EQ(m.circumradius_mm, kInfinity);
    EXPECT_EQ(m.radius_edge, kInfinity);
    for (double angle : m.dihedral_deg) EXPECT_TRUE(angle == 0 || angle == 180) << angle;
  }
  const auto square = measure_tet(flats[0][0], flats[0][1], flats[0][2], flats[0][3]).dihedral_deg;
  expect_near(sorted(square), {0, 0, 0, 0, 180, 180}, 0);
}

TEST(Measures, SliverAnglesKeepTheirDigits) {
  for (const double height : {1e-3, 1e-6, 1e-9}) {
    const TetMeasures m = measure_tet({0, 0, 0}, {1, 1, 0}, {1, 0, height}, {0, 1, height});
    const auto angles = sorted(m.dihedral_deg);
    // At the diagonals the faces rise by `height` over half a diagonal on either side.
    const double rise = std::atan(height / std::sqrt(0.5)) * 180 / M_PI;
    EXPECT_NEAR((180 - angles[5]) / (2 * rise), 1, 1e-6) << height;
    EXPECT_GT(angles[0], 0);
  }
}

TEST(Measures, HugeAndTinyTets) {
  for (const double s : {1e-90, 1e-30, 1e30, kLargestCoordinateMm}) {
    const TetMeasures m = measure_tet({0, 0, 0}, {s, 0, 0}, {0, s, 0}, {0, 0, s});
    EXPECT_FALSE(std::isnan(m.inverse_aspect)) << s;
    EXPECT_FALSE(std::isnan(m.radius_edge)) << s;
    EXPECT_FALSE(std::isnan(m.scaled_jacobian)) << s;
    EXPECT_LE(m.min_height_mm, s);
    EXPECT_LE(m.inverse_aspect, 1.0 / 3) << s;
    for (double angle : m.dihedral_deg) EXPECT_FALSE(std::isnan(angle)) << s;
  }
}

TEST(Measures, TriangleAngles) {
  const auto right = triangle_angles_deg({0, 0, 0}, {3, 0, 0}, {0, 3, 0});
  EXPECT_NEAR(right[0], 90, 1e-13);
  EXPECT_NEAR(right[1], 45, 1e-13);
  EXPECT_NEAR(right[2], 45, 1e-13);
  const auto line = triangle_angles_deg({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
  EXPECT_EQ(line[0], 0);
  EXPECT_EQ(line[1], 180);
  EXPECT_EQ(line[2], 0);
}

}  // namespace
}  // namespace scantet
