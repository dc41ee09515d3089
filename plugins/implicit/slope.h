// An interval with the intervals of its derivatives (forward differentiation).
#pragma once

#include "interval.h"

namespace implicit {

/// The derivatives by x, y and z.
struct Gradient {
  Interval x, y, z;
};

inline Gradient operator-(const Gradient& a) {
  return {-a.x, -a.y, -a.z};
}
inline Gradient operator+(const Gradient& a, const Gradient& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Gradient operator-(const Gradient& a, const Gradient& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Gradient operator*(const Interval& factor, const Gradient& a) {
  return {factor * a.x, factor * a.y, factor * a.z};
}
inline Gradient operator/(const Gradient& a, const Interval& b) {
  return {a.x / b, a.y / b, a.z / b};
}
inline Gradient hull(const Gradient& a, const Gradient& b) {
  return {hull(a.x, b.x), hull(a.y, b.y), hull(a.z, b.z)};
}

/// Values of a function over a range of its variables, and its derivatives there: along a line by t (Rate: Interval),
/// or by x, y and z (Rate: Gradient). Where the function has a kink (abs, min, max), `rate` holds the derivatives on
/// both sides, so that the mean value theorem holds with it.
template <class Rate>
struct Differentiated {
  Interval value;
  Rate rate;
};
using Slope = Differentiated<Interval>;
using Slopes = Differentiated<Gradient>;

template <class Rate>
Differentiated<Rate> operator-(const Differentiated<Rate>& a) {
  return {-a.value, -a.rate};
}
template <class Rate>
Differentiated<Rate> operator+(const Differentiated<Rate>& a, const Differentiated<Rate>& b) {
  return {a.value + b.value, a.rate + b.rate};
}
template <class Rate>
Differentiated<Rate> operator-(const Differentiated<Rate>& a, const Differentiated<Rate>& b) {
  return {a.value - b.value, a.rate - b.rate};
}
template <class Rate>
Differentiated<Rate> operator*(const Differentiated<Rate>& a, const Differentiated<Rate>& b) {
  return {a.value * b.value, a.value * b.rate + b.value * a.rate};
}
template <class Rate>
Differentiated<Rate> operator/(const Differentiated<Rate>& a, const Differentiated<Rate>& b) {
  const Interval quotient = a.value / b.value;
  return {quotient, (a.rate - quotient * b.rate) / b.value};
}
template <class Rate>
Differentiated<Rate> power(const Differentiated<Rate>& a, int n) {
  if (n == 0) return {{1, 1}, {}};
  const Interval factor{static_cast<double>(n), static_cast<double>(n)};
  return {power(a.value, n), factor * power(a.value, n - 1) * a.rate};
}
template <class Rate>
Differentiated<Rate> sin(const Differentiated<Rate>& a) {
  return {sin(a.value), cos(a.value) * a.rate};
}
template <class Rate>
Differentiated<Rate> cos(const Differentiated<Rate>& a) {
  return {cos(a.value), -(sin(a.value) * a.rate)};
}
template <class Rate>
Differentiated<Rate> exp(const Differentiated<Rate>& a) {
  const Interval value = exp(a.value);
  return {value, value * a.rate};
}
template <class Rate>
Differentiated<Rate> log(const Differentiated<Rate>& a) {
  return {log(a.value), a.rate / a.value};
}
template <class Rate>
Differentiated<Rate> sqrt(const Differentiated<Rate>& a) {
  const Interval root = sqrt(a.value);
  return {root, a.rate / (root + root)};
}
template <class Rate>
Differentiated<Rate> abs(const Differentiated<Rate>& a) {
  if (a.value.lo > 0) return a;
  if (a.value.hi < 0) return -a;
  return {abs(a.value), hull(a.rate, -a.rate)};
}
template <class Rate>
Differentiated<Rate> smaller(const Differentiated<Rate>& a, const Differentiated<Rate>& b) {
  if (a.value.hi < b.value.lo) return a;
  if (b.value.hi < a.value.lo) return b;
  return {smaller(a.value, b.value), hull(a.rate, b.rate)};
}
template <class Rate>
Differentiated<Rate> larger(const Differentiated<Rate>& a, const Differentiated<Rate>& b) {
  if (a.value.lo > b.value.hi) return a;
  if (b.value.lo > a.value.hi) return b;
  return {larger(a.value, b.value), hull(a.rate, b.rate)};
}

}  // namespace implicit
