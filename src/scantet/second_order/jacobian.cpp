// With control points b_ij (of corners the corners, of edges 2·node - mean of the corners) the element is
// sum over i, j of l_i l_j b_ij in barycentric coordinates l, and its derivative along the edge from corner 0 to corner
// k is sum over j of l_j d_kj, d_kj = 2 (b_kj - b_0j). The determinant is so a sum of determinants of three such
// vectors, each with a product of three of the l. All points are taken from corner 0 first, which keeps rounding small.
#include "scantet/second_order/jacobian.h"

#include <algorithm>
#include <span>

namespace scantet {
namespace {

using Degrees = std::array<int, 4>;

/// The exponents of the 20 terms, and where each is.
struct Terms {
  std::array<Degrees, 20> of{};
  int at[4][4][4] = {};

  constexpr Terms() {
    std::size_t next = 0;
    for (int a = 0; a <= 3; ++a) {
      for (int b = 0; a + b <= 3; ++b) {
        for (int c = 0; a + b + c <= 3; ++c) {
          at[a][b][c] = static_cast<int>(next);
          of[next++] = {a, b, c, 3 - a - b - c};
        }
      }
    }
  }
  constexpr std::size_t index(const Degrees& d) const { return static_cast<std::size_t>(at[d[0]][d[1]][d[2]]); }
};
constexpr Terms kTerms;

constexpr int kFactorial[4] = {1, 1, 2, 6};
constexpr double kChoose[4][4] = {{1, 0, 0, 0}, {1, 1, 0, 0}, {1, 2, 1, 0}, {1, 3, 3, 1}};
constexpr int kDepth = 9;

/// Orders of cuts: opposite edges after each other.
constexpr std::size_t kCuts[6][2] = {{0, 1}, {2, 3}, {0, 2}, {1, 3}, {0, 3}, {1, 2}};

using Coefficients = std::array<double, 20>;

/// The coefficients on the half where corner `gone` is replaced by the middle of the edge to `kept` (de Casteljau).
Coefficients half(const Coefficients& whole, std::size_t kept, std::size_t gone) {
  Coefficients part;
  for (std::size_t i = 0; i < 20; ++i) {
    const Degrees& degrees = kTerms.of[i];
    const int n = degrees[gone];
    double sum = 0;
    for (int k = 0; k <= n; ++k) {
      Degrees from = degrees;
      from[kept] += n - k;
      from[gone] = k;
      sum += kChoose[n][k] * whole[kTerms.index(from)];
    }
    part[i] = sum / static_cast<double>(1 << n);
  }
  return part;
}

bool proves_above(const Coefficients& c, double least, int depth) {
  if (*std::min_element(c.begin(), c.end()) > least) return true;
  for (std::size_t corner = 0; corner < 4; ++corner) {  // there the polynomial is its coefficient
    Degrees degrees{};
    degrees[corner] = 3;
    if (!(c[kTerms.index(degrees)] > least)) return false;
  }
  if (depth == kDepth) return false;
  const auto& cut = kCuts[depth % 6];
  return proves_above(half(c, cut[0], cut[1]), least, depth + 1) &&
         proves_above(half(c, cut[1], cut[0]), least, depth + 1);
}

}  // namespace

TetJacobian::TetJacobian(const TetNodes& nodes) {
  // Control points from corner 0, by pairs of corners.
  std::array<std::array<Vec, 4>, 4> b;
  double reach = 0;
  for (std::size_t i = 0; i < 4; ++i) b[i][i] = nodes[i] - nodes[0];
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [i, j] = kEdgesOfNodes[e];
    b[i][j] = b[j][i] = 2.0 * (nodes[4 + e] - nodes[0]) - 0.5 * (b[i][i] + b[j][j]);
  }
  for (const auto& row : b) {
    for (const Vec& p : row) reach = std::max({reach, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  std::array<std::array<Vec, 4>, 3> d;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t j = 0; j < 4; ++j) d[k][j] = 2.0 * (b[k + 1][j] - b[0][j]);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      const Vec normal = cross(d[0][i], d[1][j]);
      for (std::size_t k = 0; k < 4; ++k) {
        Degrees degrees{};
        ++degrees[i];
        ++degrees[j];
        ++degrees[k];
        coefficients_[kTerms.index(degrees)] += dot(normal, d[2][k]);
      }
    }
  }
  for (std::size_t t = 0; t < 20; ++t) {
    int count = 6;
    for (const int degree : kTerms.of[t]) count /= kFactorial[degree];
    coefficients_[t] /= count;
  }
  // Entries of d are at most 4 reach, and off by less than 16 of the unit roundoff u of that; a determinant of them has
  // six products, each off by 3 · 16 u, and six roundings: 6 · (48 + 6) u · (4 reach)³; sums of six of them and halves
  // of halves add less than as much again.
  constexpr double kUnit = 1.2e-16;
  const double entry = 4 * reach;
  error_mm3_ = 2 * 6 * 54 * kUnit * entry * entry * entry;
}

double TetJacobian::volume_mm3() const {
  double sum = 0;
  for (const double c : coefficients_) sum += c;
  return sum / 120;
}

bool TetJacobian::is_above(double least_mm3) const {
  return proves_above(coefficients_, least_mm3 + error_mm3_, 0);
}

double TetJacobian::lower_bound_mm3() const {
  return *std::min_element(coefficients_.begin(), coefficients_.end()) - error_mm3_;
}

}  // namespace scantet
