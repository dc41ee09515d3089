// An interval with the interval of its derivative along a line (forward differentiation).
#pragma once

#include "interval.h"

namespace implicit {

/// Values of a function of one variable t over an interval of t, and its slopes there. Where the function has a kink
/// (abs, min, max), `rate` holds the slopes on both sides, so that the mean value theorem holds with it.
struct Slope {
  Interval value;
  Interval rate;  ///< d value / dt
};

inline Slope operator-(const Slope& a) {
  return {-a.value, -a.rate};
}
inline Slope operator+(const Slope& a, const Slope& b) {
  return {a.value + b.value, a.rate + b.rate};
}
inline Slope operator-(const Slope& a, const Slope& b) {
  return {a.value - b.value, a.rate - b.rate};
}
inline Slope operator*(const Slope& a, const Slope& b) {
  return {a.value * b.value, a.value * b.rate + a.rate * b.value};
}
inline Slope operator/(const Slope& a, const Slope& b) {
  const Interval quotient = a.value / b.value;
  return {quotient, (a.rate - quotient * b.rate) / b.value};
}
inline Slope power(const Slope& a, int n) {
  if (n == 0) return {{1, 1}, {0, 0}};
  const Interval factor{static_cast<double>(n), static_cast<double>(n)};
  return {power(a.value, n), factor * power(a.value, n - 1) * a.rate};
}
inline Slope sin(const Slope& a) {
  return {sin(a.value), cos(a.value) * a.rate};
}
inline Slope cos(const Slope& a) {
  return {cos(a.value), -(sin(a.value) * a.rate)};
}
inline Slope exp(const Slope& a) {
  const Interval value = exp(a.value);
  return {value, value * a.rate};
}
inline Slope log(const Slope& a) {
  return {log(a.value), a.rate / a.value};
}
inline Slope sqrt(const Slope& a) {
  const Interval root = sqrt(a.value);
  return {root, a.rate / (root + root)};
}
inline Slope abs(const Slope& a) {
  if (a.value.lo > 0) return a;
  if (a.value.hi < 0) return -a;
  return {abs(a.value), hull(a.rate, -a.rate)};
}
inline Slope smaller(const Slope& a, const Slope& b) {
  if (a.value.hi < b.value.lo) return a;
  if (b.value.hi < a.value.lo) return b;
  return {smaller(a.value, b.value), hull(a.rate, b.rate)};
}
inline Slope larger(const Slope& a, const Slope& b) {
  if (a.value.lo > b.value.hi) return a;
  if (b.value.lo > a.value.hi) return b;
  return {larger(a.value, b.value), hull(a.rate, b.rate)};
}

}  // namespace implicit
