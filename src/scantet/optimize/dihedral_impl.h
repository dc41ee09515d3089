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

/// The sharpness of a tet that is not positively oriented: more than that of any angle.
inline constexpr double kInverted = 2;

/// The edge vectors of a tet and their products, from which its angles and its other measures are computed.
struct TetForm {
  Vec a, b, c;     // from the first corner to the others
  Vec bc, ca, ab;  // cross products
  double det;      // six times the volume

  TetForm(const Point& p, const Point& q, const Point& r, const Point& s)
      : a(q - p), b(r - p), c(s - p), bc(cross(b, c)), ca(cross(c, a)), ab(cross(a, b)), det(dot(a, bc)) {}
};

/// The sharpness of the smallest and of the largest dihedral angle of a tet that is positively oriented.
struct DihedralCosines {
  double sharpest = -1;
  double bluntest = 1;

  /// The squared cosine of the smallest angle if that is under 90°, and of the largest if that is over 90°; else 0.
  double sharp() const { return std::max(sharpest, 0.0); }
  double blunt() const { return std::max(-bluntest, 0.0); }

  explicit DihedralCosines(const TetForm& t) {
    // Normals of the faces opposite to the corners; all point out of the tet or, here, all into it.
    const std::array<Vec, 4> normals{-1.0 * (t.bc + t.ca + t.ab), t.bc, t.ca, t.ab};
    std::array<double, 4> inverse{};
    for (std::size_t i = 0; i < 4; ++i) inverse[i] = 1 / squared_length(normals[i]);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        const double product = -dot(normals[i], normals[j]);
        const double sharpness = product * std::abs(product) * inverse[i] * inverse[j];
        sharpest = std::max(sharpest, sharpness);
        bluntest = std::min(bluntest, sharpness);
      }
    }
  }
};

/// The sharpness of the smallest dihedral angle of the tet: the less, the better. kInverted if it is not positively
/// oriented as computed.
inline double tet_sharpness(const Point& p, const Point& q, const Point& r, const Point& s) {
  const TetForm t(p, q, r, s);
  return t.det > 0 ? DihedralCosines(t).sharpest : kInverted;
}

}  // namespace scantet::optimize
