// Numbers of which only bounds are known: the verifier's own arithmetic.
//
// Boost's intervals change the processor's rounding mode, which the compiler does not know of and which costs more than
// the sums themselves. Here each operation is done as usual, to the nearest number, and its result is widened by a
// little more than the error that this makes: two units in the last place. No mode is changed, and threads share
// nothing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "scantet/base/geometry.h"

namespace scantet::verify {

/// A number at most x less the rounding error of the operation that gave x. Beyond 2^-1000 the margin is absolute.
inline double below(double x) {
  return x - (std::abs(x) * 0x1p-52 + 0x1p-1000);
}
/// The same above.
inline double above(double x) {
  return x + (std::abs(x) * 0x1p-52 + 0x1p-1000);
}

/// All numbers from lo to hi. Magnitudes must stay below 1e300, which the callers' limits on what they read see to.
struct Interval {
  double lo = 0;
  double hi = 0;

  Interval() = default;
  Interval(double exact) : lo(exact), hi(exact) {}  // NOLINT: a number is an interval
  Interval(double low, double high) : lo(low), hi(high) {}

  bool is_positive() const { return lo > 0; }
  bool is_negative() const { return hi < 0; }
  double middle() const { return 0.5 * (lo + hi); }
  /// The largest absolute value.
  double magnitude() const { return std::max(-lo, hi); }
};

inline Interval operator-(const Interval& a) {
  return {-a.hi, -a.lo};
}
inline Interval operator+(const Interval& a, const Interval& b) {
  return {below(a.lo + b.lo), above(a.hi + b.hi)};
}
inline Interval operator-(const Interval& a, const Interval& b) {
  return {below(a.lo - b.hi), above(a.hi - b.lo)};
}
inline Interval operator*(const Interval& a, const Interval& b) {
  const double p = a.lo * b.lo;
  const double q = a.lo * b.hi;
  const double r = a.hi * b.lo;
  const double s = a.hi * b.hi;
  return {below(std::min(std::min(p, q), std::min(r, s))), above(std::max(std::max(p, q), std::max(r, s)))};
}
/// The smallest interval that holds both.
inline Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}
/// Of all numbers in a, which must not reach below zero by more than rounding.
inline Interval root(const Interval& a) {
  return {std::max(0.0, below(std::sqrt(std::max(0.0, a.lo)))), above(std::sqrt(std::max(0.0, a.hi)))};
}
/// a / b. Pre: b does not hold zero.
inline Interval quotient(const Interval& a, const Interval& b) {
  const Interval inverse{below(1 / b.hi), above(1 / b.lo)};
  return a * inverse;
}

/// Three of them: a place or a displacement that is known up to rounding.
struct IntervalVec {
  std::array<Interval, 3> at;

  IntervalVec() = default;
  IntervalVec(const Interval& x, const Interval& y, const Interval& z) : at{x, y, z} {}
  explicit IntervalVec(const Vec& v) : at{Interval(v.x), Interval(v.y), Interval(v.z)} {}

  const Interval& operator[](int axis) const { return at[static_cast<std::size_t>(axis)]; }
  Interval& operator[](int axis) { return at[static_cast<std::size_t>(axis)]; }
  Vec middle() const { return {at[0].middle(), at[1].middle(), at[2].middle()}; }
};

inline IntervalVec operator+(const IntervalVec& a, const IntervalVec& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline IntervalVec operator-(const IntervalVec& a, const IntervalVec& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline IntervalVec operator*(const Interval& s, const IntervalVec& v) {
  return {s * v[0], s * v[1], s * v[2]};
}
inline Interval dot(const IntervalVec& a, const IntervalVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline IntervalVec cross(const IntervalVec& a, const IntervalVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Interval det(const IntervalVec& a, const IntervalVec& b, const IntervalVec& c) {
  return dot(a, cross(b, c));
}
/// The upper bound of the vector's length.
inline double length_bound(const IntervalVec& v) {
  Interval sum;
  for (int axis = 0; axis < 3; ++axis) {
    const Interval m(v[axis].magnitude());
    sum = sum + m * m;
  }
  return root(sum).hi;
}
/// The smallest box with bounds that hold all coordinates.
inline void extend(Box& box, const IntervalVec& p) {
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::min(box.min[axis], p[axis].lo);
    box.max[axis] = std::max(box.max[axis], p[axis].hi);
  }
}

}  // namespace scantet::verify
