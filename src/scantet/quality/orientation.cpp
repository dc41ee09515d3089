// The determinant in doubles decides if it is larger than a bound on its own rounding error; otherwise it is summed
// without error as an expansion: a list of doubles of growing magnitude whose bits do not overlap. Bound and sums after
// Shewchuk, Adaptive precision floating-point arithmetic and fast robust geometric predicates (1997), sections 2 and 4.
#include "scantet/quality/orientation.h"

#include <vector>

namespace scantet {
namespace {

using Expansion = std::vector<double>;  // no zeros; empty is zero; the sign is that of the last term

struct TwoTerms {
  double high;
  double low;
};

// high + low == a + b, exactly.
TwoTerms two_sum(double a, double b) {
  const double high = a + b;
  const double b_part = high - a;
  const double a_part = high - b_part;
  return {high, (a - a_part) + (b - b_part)};
}

// high + low == a * b, exactly.
TwoTerms two_product(double a, double b) {
  const double high = a * b;
  return {high, std::fma(a, b, -high)};
}

void add(Expansion& e, double b) {
  std::size_t kept = 0;
  for (const double term : e) {
    const TwoTerms sum = two_sum(b, term);
    if (sum.low != 0) e[kept++] = sum.low;
    b = sum.high;
  }
  e.resize(kept);
  if (b != 0) e.push_back(b);
}

void add(Expansion& e, const TwoTerms& t) {
  add(e, t.low);
  add(e, t.high);
}

Expansion difference(double a, double b) {
  Expansion e;
  add(e, two_sum(a, -b));
  return e;
}

Expansion product(const Expansion& e, const Expansion& f, double sign = 1) {
  Expansion result;
  for (const double a : e) {
    for (const double b : f) add(result, two_product(sign * a, b));
  }
  return result;
}

void add(Expansion& e, const Expansion& f) {
  for (const double term : f) add(e, term);
}

int exact_sign(const Point& a, const Point& b, const Point& c, const Point& d) {
  std::array<std::array<Expansion, 3>, 3> rows;
  const std::array<Point, 3> ends{b, c, d};
  for (std::size_t i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) rows[i][static_cast<std::size_t>(axis)] = difference(ends[i][axis], a[axis]);
  }
  Expansion det;
  for (std::size_t x = 0; x < 3; ++x) {
    const std::size_t y = (x + 1) % 3;
    const std::size_t z = (x + 2) % 3;
    Expansion minor = product(rows[1][y], rows[2][z]);
    add(minor, product(rows[1][z], rows[2][y], -1));
    add(det, product(rows[0][x], minor));
  }
  if (det.empty()) return 0;
  return det.back() > 0 ? 1 : -1;
}

}  // namespace

int orientation_sign(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Vec u = b - a;
  const Vec v = c - a;
  const Vec w = d - a;
  const double vy_wz = v.y * w.z;
  const double vz_wy = v.z * w.y;
  const double vz_wx = v.z * w.x;
  const double vx_wz = v.x * w.z;
  const double vx_wy = v.x * w.y;
  const double vy_wx = v.y * w.x;
  const double det = u.x * (vy_wz - vz_wy) + u.y * (vz_wx - vx_wz) + u.z * (vx_wy - vy_wx);
  const double permanent = std::abs(u.x) * (std::abs(vy_wz) + std::abs(vz_wy)) +
                           std::abs(u.y) * (std::abs(vz_wx) + std::abs(vx_wz)) +
                           std::abs(u.z) * (std::abs(vx_wy) + std::abs(vy_wx));
  constexpr double kHalfUlp = 0.5 * std::numeric_limits<double>::epsilon();
  constexpr double kErrorBound = (7 + 56 * kHalfUlp) * kHalfUlp;
  if (det > kErrorBound * permanent) return 1;
  if (-det > kErrorBound * permanent) return -1;
  return exact_sign(a, b, c, d);
}

}  // namespace scantet
