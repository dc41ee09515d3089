// Interval arithmetic: what a formula can come to when its variables lie in given intervals.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace implicit {

/// The numbers from lo to hi; lo may be -infinity and hi +infinity, neither is NaN. An operation gives an interval that
/// holds every exact result for operands in its operands, and every result of the same operation on doubles; where
/// that would be NaN (sqrt(-1), 0/0), it gives all numbers.
struct Interval {
  double lo, hi;

  bool excludes_zero() const { return lo > 0 || hi < 0; }
};

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr Interval kAllNumbers{-kInfinity, kInfinity};

/// A little more than [lo, hi], whose ends were rounded to nearest (or come from the C library, less than 1 ulp off).
/// All numbers if an end is NaN or beyond the largest double.
inline Interval outward(double lo, double hi) {
  constexpr double kUlps = 0x1p-50;   // four units in the last place
  constexpr double kTiny = 0x1p-900;  // far from the subnormal numbers, which are slow
  if (!(lo <= hi) || lo == kInfinity || hi == -kInfinity) return kAllNumbers;
  return {lo - (std::abs(lo) * kUlps + kTiny), hi + (std::abs(hi) * kUlps + kTiny)};
}

inline Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}
inline Interval operator-(const Interval& a) {
  return {-a.hi, -a.lo};
}
inline Interval operator+(const Interval& a, const Interval& b) {
  return outward(a.lo + b.lo, a.hi + b.hi);
}
inline Interval operator-(const Interval& a, const Interval& b) {
  return outward(a.lo - b.hi, a.hi - b.lo);
}
inline Interval operator*(const Interval& a, const Interval& b) {
  const double p = a.lo * b.lo;
  const double q = a.lo * b.hi;
  const double r = a.hi * b.lo;
  const double s = a.hi * b.hi;
  if (std::isnan(p + q + r + s)) return kAllNumbers;  // min and max would hide a NaN
  return outward(std::min({p, q, r, s}), std::max({p, q, r, s}));
}
inline Interval operator/(const Interval& a, const Interval& b) {
  if (!b.excludes_zero()) return kAllNumbers;
  return a * outward(1 / b.hi, 1 / b.lo);
}

inline Interval abs(const Interval& a) {
  if (a.lo >= 0) return a;
  if (a.hi <= 0) return -a;
  return {0, std::max(-a.lo, a.hi)};
}
inline Interval smaller(const Interval& a, const Interval& b) {
  return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)};
}
inline Interval larger(const Interval& a, const Interval& b) {
  return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)};
}
inline Interval sqrt(const Interval& a) {
  if (a.lo < 0) return kAllNumbers;
  return outward(std::sqrt(a.lo), std::sqrt(a.hi));
}
inline Interval exp(const Interval& a) {
  return outward(std::exp(a.lo), std::exp(a.hi));
}
inline Interval log(const Interval& a) {
  if (!(a.lo > 0)) return kAllNumbers;
  return outward(std::log(a.lo), std::log(a.hi));
}

/// Whether some period * k + phase, k whole, is in the interval, or so near that rounding leaves it open.
inline bool may_meet(const Interval& a, double phase, double period) {
  constexpr double kSlack = 1e-9;
  return std::floor((a.hi - phase) / period + kSlack) >= std::ceil((a.lo - phase) / period - kSlack);
}
/// Of a wave of period 2 pi between -1 and 1 that has a top at `top`, and comes to `first` and `last` at a's ends.
inline Interval wave(const Interval& a, double first, double last, double top) {
  constexpr double kFarthest = 1e5;  // beyond it the slack would not do
  constexpr double kPeriod = 2 * std::numbers::pi;
  if (!(a.lo > -kFarthest && a.hi < kFarthest)) return {-1, 1};
  const Interval between = outward(std::min(first, last), std::max(first, last));
  return {may_meet(a, top + std::numbers::pi, kPeriod) ? -1 : std::max(-1.0, between.lo),
          may_meet(a, top, kPeriod) ? 1 : std::min(1.0, between.hi)};
}
inline Interval sin(const Interval& a) {
  return wave(a, std::sin(a.lo), std::sin(a.hi), 0.5 * std::numbers::pi);
}
inline Interval cos(const Interval& a) {
  return wave(a, std::cos(a.lo), std::cos(a.hi), 0);
}

/// x multiplied n times with itself, n ≥ 0. On doubles of one sign it is monotone, rounding included.
inline double whole_power(double x, int n) {
  if (n == 2) return x * x;
  if (n == 4) return (x * x) * (x * x);
  double result = 1;
  for (double square = x; n > 0; n /= 2, square *= square) {
    if (n % 2 == 1) result *= square;
  }
  return result;
}
inline double power(double x, int n) {
  return n < 0 ? 1 / whole_power(x, -n) : whole_power(x, n);
}
inline Interval power(const Interval& a, int n) {
  if (n < 0) return Interval{1, 1} / power(a, -n);
  if (n == 0) return {1, 1};
  if (n == 1) return a;
  constexpr double kUlp = std::numeric_limits<double>::epsilon();
  const Interval base = n % 2 == 0 ? abs(a) : a;
  Interval result = outward(whole_power(base.lo, n), whole_power(base.hi, n));
  result.lo -= n * kUlp * std::abs(result.lo);  // each of the products is rounded
  result.hi += n * kUlp * std::abs(result.hi);
  return n % 2 == 0 ? larger(result, {0, 0}) : result;
}

}  // namespace implicit
