// Private: how sharp a tet's dihedral angles are, without a root or an arc cosine.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scantet/base/tet_mesh.h"

namespace scantet::optimize {

/// The sharpness of an angle θ: cos θ·|cos θ|, which falls from 1 at 0° to -1 at 180°.
inline double sharpness_of_angle(double degrees) {
  const double cosine = std::cos(degrees * std::numbers::pi / 180);
  return cosine * std::abs(cosine);
}

/// The angle of a sharpness, degrees; 0 for kInverted.
inline double angle_of_sharpness(double sharpness) {
  const double cosine = std::copysign(std::sqrt(std::min(std::abs(sharpness), 1.0)), sharpness);
  return std::acos(cosine) * 180 / std::numbers::pi;
}

/// Sharper than any angle: of a tet that is not positively oriented.
inline constexpr double kInverted = 2;

/// The sharpness of the smallest dihedral angle of the tet: the less, the better. kInverted if it is not positively
/// oriented as computed.
inline double tet_sharpness(const Point& p, const Point& q, const Point& r, const Point& s) {
  const Vec a = q - p;
  const Vec b = r - p;
  const Vec c = s - p;
  const Vec bc = cross(b, c);
  if (!(dot(a, bc) > 0)) return kInverted;
  const Vec ca = cross(c, a);
  const Vec ab = cross(a, b);
  // Normals of the faces opposite to p, q, r and s; all point out of the tet or, here, all into it.
  const std::array<Vec, 4> normals{-1.0 * (bc + ca + ab), bc, ca, ab};
  std::array<double, 4> inverse{};
  for (std::size_t i = 0; i < 4; ++i) inverse[i] = 1 / squared_length(normals[i]);
  double sharpest = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      const double product = -dot(normals[i], normals[j]);
      sharpest = std::max(sharpest, product * std::abs(product) * inverse[i] * inverse[j]);
    }
  }
  return sharpest;
}

}  // namespace scantet::optimize
