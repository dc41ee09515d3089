// Eigenvalues of symmetric 3 × 3 matrices in closed form, after Smith, Eigenvalues of a symmetric 3 × 3 matrix (1961).
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scantet/base/geometry.h"

namespace scantet {

/// xx xy xz
/// xy yy yz
/// xz yz zz
struct SymmetricMatrix {
  double xx, yy, zz, xy, xz, yz;
};

/// The eigenvalues are mean + 2 spread cos(angle + 2πk / 3): the largest for k = 0, the least for k = 1.
struct EigenvalueForm {
  double mean;
  double spread;  ///< 0 if they are all the same
  double angle;   ///< from 0 to π/3

  double largest() const { return mean + 2 * spread * std::cos(angle); }
  double least() const { return mean + 2 * spread * std::cos(angle + 2 * std::numbers::pi / 3); }
};

/// Right to some 8 digits of the largest. Pre: the cubes of its entries neither overflow nor vanish.
inline EigenvalueForm eigenvalue_form(const SymmetricMatrix& m) {
  const double mean = (m.xx + m.yy + m.zz) / 3;
  const Vec d{m.xx - mean, m.yy - mean, m.zz - mean};
  const double spread = std::sqrt((dot(d, d) + 2 * (m.xy * m.xy + m.xz * m.xz + m.yz * m.yz)) / 6);
  if (!(spread > 0)) return {mean, 0, 0};
  const double determinant =
      d.x * (d.y * d.z - m.yz * m.yz) - m.xy * (m.xy * d.z - m.yz * m.xz) + m.xz * (m.xy * m.yz - d.y * m.xz);
  const double cosine = std::clamp(determinant / (2 * spread * spread * spread), -1.0, 1.0);
  return {mean, spread, std::acos(cosine) / 3};
}

}  // namespace scantet
