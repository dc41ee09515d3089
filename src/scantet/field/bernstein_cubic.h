// Where a cubic in Bernstein form changes its sign.
#pragma once

#include <array>

#include "scantet/base/api.h"

namespace SCANTET_API scantet {

/// The cubic b0·(1-t)³ + 3·b1·(1-t)²·t + 3·b2·(1-t)·t² + b3·t³ on [0, 1]. Values lie between the smallest and the
/// largest coefficient.
using BernsteinCubic = std::array<double, 4>;

/// The cubic at t in [0, 1], by de Casteljau: never outside of the range of the coefficients by more than rounding, and
/// of their sign where they share one.
double value_at(const BernsteinCubic& b, double t);

/// Whether the cubic is > 0 just before t = 1; `otherwise` if it is zero everywhere.
bool positive_before_end(const BernsteinCubic& b, bool otherwise);

/// At most three parameters in ascending order.
struct SignChanges {
  int count = 0;              ///< how many there are
  std::array<double, 3> t{};  ///< the first `count` of these; the others say nothing
};

/// Every t in [0, 1] where the cubic passes from > 0 to ≤ 0 or back, ascending. b: finite.
///
/// The caller knows the signs at the two ends (from a neighbouring cell, say) and they overrule rounding: count is odd
/// exactly if positive_at_start != positive_at_end. Where a sign differs from what the values say, the change is put at
/// the end of its monotone piece with the smaller absolute value. A double root, to rounding, is no sign change.
/// Guarantees: t is exact to the resolution of [0, 1], or as far as the conditioning of the root allows.
SignChanges sign_changes(const BernsteinCubic& b, bool positive_at_start, bool positive_at_end);

}  // namespace scantet
