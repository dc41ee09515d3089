// The derivative is a quadratic in Bernstein form; its roots, solved without cancellation, split [0, 1] into at most
// three monotone pieces. A piece whose ends differ in sign holds exactly one root, which Newton's method finds. The
// root stays bracketed, and a bisection follows whenever Newton does not halve its step, so the method cannot fail.
// Everything is evaluated by de Casteljau, so nothing is ever converted to the monomial basis, where close roots would
// drown.
#include "scantet/field/bernstein_cubic.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scantet {
namespace {

struct ValueAndSlope {
  double value;
  double slope;
};

ValueAndSlope evaluate(const BernsteinCubic& b, double t) {
  const double s = 1 - t;
  const double p0 = s * b[0] + t * b[1];
  const double p1 = s * b[1] + t * b[2];
  const double p2 = s * b[2] + t * b[3];
  const double q0 = s * p0 + t * p1;
  const double q1 = s * p1 + t * p2;
  return {s * q0 + t * q1, 3 * (q1 - q0)};
}

/// Critical points inside (0, 1), ascending. With r = t/(1-t) the derivative is d2·r² + 2·d1·r + d0 up to a positive
/// factor; only r > 0 counts, and there t = r/(1+r) has no cancellation.
int critical_points(const BernsteinCubic& b, std::array<double, 2>& t) {
  const double scale = std::max({std::abs(b[1] - b[0]), std::abs(b[2] - b[1]), std::abs(b[3] - b[2])});
  if (!(scale > 0)) return 0;
  const double d0 = (b[1] - b[0]) / scale;  // so that squares neither overflow nor vanish
  const double d1 = (b[2] - b[1]) / scale;
  const double d2 = (b[3] - b[2]) / scale;
  const double discriminant = d1 * d1 - d0 * d2;
  if (!(discriminant > 0)) return 0;
  const double q = -(d1 + std::copysign(std::sqrt(discriminant), d1));
  int count = 0;
  for (const auto& [numerator, denominator] : {std::array{q, d2}, std::array{d0, q}}) {
    const bool positive = (numerator > 0 && denominator > 0) || (numerator < 0 && denominator < 0);
    const double at = positive ? numerator / (numerator + denominator) : 0;
    if (at > 0 && at < 1) t[count++] = at;
  }
  if (count == 2 && t[0] > t[1]) std::swap(t[0], t[1]);
  return count;
}

/// An end of a monotone piece: its parameter, and the cubic there.
struct Knot {
  double t;
  double value;
};

/// The root between two knots whose values have opposite strict signs.
double root_between(const BernsteinCubic& b, const Knot& low, const Knot& high) {
  constexpr double kResolution = std::numeric_limits<double>::epsilon() / 2;
  constexpr int kEnough = 200;  // bisection alone needs 53
  double lo = low.t;
  double hi = high.t;
  double t = lo + (hi - lo) * (low.value / (low.value - high.value));
  double step_before = hi - lo;
  for (int iteration = 0; iteration < kEnough; ++iteration) {
    const ValueAndSlope f = evaluate(b, t);
    if (f.value == 0) return t;
    ((f.value > 0) == (low.value > 0) ? lo : hi) = t;
    double step = -f.value / f.slope;
    const bool good = t + step > lo && t + step < hi && std::abs(step) <= 0.5 * std::abs(step_before);
    if (!good && !(std::abs(step) <= kResolution)) step = 0.5 * (lo + hi) - t;
    const double next = std::clamp(t + step, lo, hi);
    if (std::abs(step) <= kResolution || next == t) return next;
    step_before = step;
    t = next;
  }
  return t;
}

double change_between(const BernsteinCubic& b, const Knot& low, const Knot& high) {
  const bool bracket = (low.value > 0 && high.value < 0) || (low.value < 0 && high.value > 0);
  if (bracket) return root_between(b, low, high);
  return std::abs(low.value) <= std::abs(high.value) ? low.t : high.t;
}

}  // namespace

double value_at(const BernsteinCubic& b, double t) {
  return evaluate(b, t).value;
}

bool positive_before_end(const BernsteinCubic& b, bool otherwise) {
  const auto last = std::find_if(b.rbegin(), b.rend(), [](double coefficient) { return coefficient != 0; });
  return last == b.rend() ? otherwise : *last > 0;
}

SignChanges sign_changes(const BernsteinCubic& b, bool positive_at_start, bool positive_at_end) {
  SignChanges changes;
  const auto [least, most] = std::minmax_element(b.begin(), b.end());
  const bool one_sign = *least > 0 || *most <= 0;
  if (one_sign && positive_at_start == positive_at_end && positive_at_start == (*least > 0)) return changes;

  std::array<double, 2> critical{};
  const int count = one_sign ? 0 : critical_points(b, critical);
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * std::max(std::abs(*least), std::abs(*most));
  Knot before{0, b[0]};
  bool positive = positive_at_start;
  const auto close_piece = [&](const Knot& knot, bool positive_there) {
    if (positive_there != positive) changes.t[changes.count++] = change_between(b, before, knot);
    positive = positive_there;
    before = knot;
  };
  for (int i = 0; i < count; ++i) {
    const Knot knot{critical[i], value_at(b, critical[i])};
    close_piece(knot, std::abs(knot.value) <= rounding ? positive : knot.value > 0);
  }
  close_piece({1, b[3]}, positive_at_end);
  return changes;
}

}  // namespace scantet
