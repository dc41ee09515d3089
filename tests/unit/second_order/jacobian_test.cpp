// The Bezier form of the determinant against the determinant itself.
#include "scantet/second_order/jacobian.h"

#include <gtest/gtest.h>

#include <random>

namespace scantet {
namespace {

TetNodes straight(const std::array<Point, 4>& corners) {
  TetNodes nodes;
  std::copy(corners.begin(), corners.end(), nodes.begin());
  for (std::size_t e = 0; e < 6; ++e)
    nodes[4 + e] = lerp(corners[kEdgesOfNodes[e][0]], corners[kEdgesOfNodes[e][1]], 0.5);
  return nodes;
}

TetNodes unit_tet() {
  return straight({Point{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
}

/// The determinant at barycentric coordinates, from the shape functions.
double determinant_at(const TetNodes& nodes, const std::array<double, 4>& l) {
  std::array<Vec, 4> d{};  // by each coordinate
  for (std::size_t i = 0; i < 4; ++i) d[i] = d[i] + (4 * l[i] - 1) * nodes[i];
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [i, j] = kEdgesOfNodes[e];
    d[i] = d[i] + 4 * l[j] * nodes[4 + e];
    d[j] = d[j] + 4 * l[i] * nodes[4 + e];
  }
  return dot(d[1] - d[0], cross(d[2] - d[0], d[3] - d[0]));
}

TEST(TetJacobian, OfAStraightTetIsSixTimesItsVolume) {
  const TetJacobian jacobian(unit_tet());
  EXPECT_NEAR(jacobian.volume_mm3(), 1.0 / 6, 1e-15);
  EXPECT_NEAR(jacobian.lower_bound_mm3(), 1, 1e-11);
  EXPECT_TRUE(jacobian.is_above(0.999));
  EXPECT_FALSE(jacobian.is_above(1));
}

TEST(TetJacobian, BoundsTheDeterminantAndHasItsIntegral) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> off(-0.12, 0.12);
  std::exponential_distribution<double> part(1);
  int proved = 0;
  int refuted = 0;
  for (int round = 0; round < 200; ++round) {
    TetNodes nodes = unit_tet();
    for (std::size_t e = 4; e < 10; ++e) nodes[e] = nodes[e] + Vec{off(random), off(random), off(random)};
    const TetJacobian jacobian(nodes);
    double least = 1e9;
    double sum = 0;
    constexpr int kSamples = 4000;
    for (int s = 0; s < kSamples; ++s) {
      std::array<double, 4> l{};
      double total = 0;
      for (double& x : l) total += x = part(random);
      for (double& x : l) x /= total;
      const double value = determinant_at(nodes, l);
      least = std::min(least, value);
      sum += value;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<double, 4> corner{};
      corner[i] = 1;
      least = std::min(least, determinant_at(nodes, corner));
    }
    EXPECT_LE(jacobian.lower_bound_mm3(), least);
    EXPECT_NEAR(jacobian.volume_mm3(), sum / kSamples / 6, 0.02);
    if (jacobian.is_above(0)) {
      ++proved;
      EXPECT_GT(least, 0);
    } else {
      ++refuted;
      EXPECT_LT(least, 0.05) << "what is not proved is nearly turned over at least";
    }
  }
  EXPECT_GT(proved, 20);
  EXPECT_GT(refuted, 0);
}

TEST(TetJacobian, HalvesProveWhatTheCoefficientsDoNot) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> off(-0.15, 0.15);
  int by_halves = 0;
  for (int round = 0; round < 2000; ++round) {
    TetNodes nodes = unit_tet();
    for (std::size_t e = 4; e < 10; ++e) nodes[e] = nodes[e] + Vec{off(random), off(random), off(random)};
    const TetJacobian jacobian(nodes);
    if (jacobian.lower_bound_mm3() < 0 && jacobian.is_above(0)) ++by_halves;
  }
  EXPECT_GT(by_halves, 0);
}

TEST(TetJacobian, ATurnedOverElementIsNotProved) {
  TetNodes nodes = unit_tet();
  std::swap(nodes[1], nodes[2]);
  std::swap(nodes[4], nodes[6]);
  std::swap(nodes[8], nodes[9]);
  EXPECT_FALSE(TetJacobian(nodes).is_above(0));
  nodes = unit_tet();
  nodes[4] = {-0.4, 0, 0};  // beyond a quarter of the edge
  EXPECT_FALSE(TetJacobian(nodes).is_above(0));
}

}  // namespace
}  // namespace scantet
