// The trilinear map of a box from the heights at its corners. Places are local coordinates in the box, 0 to 1.
#pragma once

#include <array>
#include <cmath>

#include "scantet/base/api.h"
#include "scantet/base/geometry.h"

namespace SCANTET_API scantet {

/// Heights at the corners of a box, such as a cell, in any unit; bit 0 of the position is x, bit 1 y, bit 2 z.
using CellHeights = std::array<double, 8>;

/// Whether some corners are inside (above zero) and some are not.
inline bool has_both_signs(const CellHeights& h) {
  int inside = 0;
  for (const double height : h) inside += height > 0;
  return inside != 0 && inside != 8;
}

/// The value between a (u = 0) and b (u = 1), both of which it meets exactly. Unlike a + u·(b-a), it never has a sign
/// that neither a nor b has: that is why a cell, or a block of them, with one sign at all nodes can be skipped without
/// a second look.
inline double mix(double a, double b, double u) {
  return (1 - u) * a + u * b;
}

/// Height at local coordinates u, each in [0, 1].
inline double trilinear(const CellHeights& h, const Vec& u) {
  const double y0 = mix(mix(h[0], h[1], u.x), mix(h[2], h[3], u.x), u.y);
  const double y1 = mix(mix(h[4], h[5], u.x), mix(h[6], h[7], u.x), u.y);
  return mix(y0, y1, u.z);
}

/// Heights at the corners of a box in the box, from local coordinates `low` to `high`, each in [0, 1]: in that box the
/// height is the trilinear map of these, and so lies between the least and the greatest of them.
inline CellHeights heights_between(const CellHeights& h, const Vec& low, const Vec& high) {
  CellHeights x;
  for (std::size_t edge = 0; edge < 8; edge += 2) {
    x[edge] = mix(h[edge], h[edge + 1], low.x);
    x[edge + 1] = mix(h[edge], h[edge + 1], high.x);
  }
  CellHeights y;
  for (const std::size_t corner : {0, 1, 4, 5}) {
    y[corner] = mix(x[corner], x[corner + 2], low.y);
    y[corner + 2] = mix(x[corner], x[corner + 2], high.y);
  }
  CellHeights z;
  for (std::size_t corner = 0; corner < 4; ++corner) {
    z[corner] = mix(y[corner], y[corner + 4], low.z);
    z[corner + 4] = mix(y[corner], y[corner + 4], high.z);
  }
  return z;
}

/// The trilinear map of a box as an affine one and what it is off from that at the most. In coordinates from -1 to 1 it
/// is an affine map plus terms in xy, yz, xz and xyz, none of which exceeds its coefficient there.
class AffineBounds {
 public:
  /// Of the box with these heights at its corners.
  explicit AffineBounds(const CellHeights& h) {
    const std::array<double, 4> sum_x{h[0] + h[1], h[2] + h[3], h[4] + h[5], h[6] + h[7]};
    const std::array<double, 4> rise_x{h[1] - h[0], h[3] - h[2], h[5] - h[4], h[7] - h[6]};
    const double yz = (sum_x[3] - sum_x[2]) - (sum_x[1] - sum_x[0]);
    const double xy = rise_x[1] - rise_x[0] + (rise_x[3] - rise_x[2]);
    const double xz = rise_x[2] - rise_x[0] + (rise_x[3] - rise_x[1]);
    const double xyz = (rise_x[3] - rise_x[2]) - (rise_x[1] - rise_x[0]);
    mean_ = (sum_x[0] + sum_x[1] + sum_x[2] + sum_x[3]) / 8;
    slope_ = {(rise_x[0] + rise_x[1] + rise_x[2] + rise_x[3]) / 8, (sum_x[1] - sum_x[0] + sum_x[3] - sum_x[2]) / 8,
              (sum_x[2] - sum_x[0] + sum_x[3] - sum_x[1]) / 8};
    bent_ = (std::abs(xy) + std::abs(yz) + std::abs(xz) + std::abs(xyz)) / 8;
  }
  /// The affine map at local coordinates u of the box, each in [0, 1], or beyond it.
  double affine_at(const Vec& u) const { return mean_ + dot(slope_, 2 * u - Vec{1, 1, 1}); }
  /// Its value in the middle of the box.
  double mean() const { return mean_; }
  /// How much the affine map rises along half an edge of the box, in the direction of each axis.
  const Vec& slope() const { return slope_; }
  /// What the height is off from the affine map at the most, in the box; ≥ 0.
  double bent() const { return bent_; }

 private:
  double mean_;
  Vec slope_;
  double bent_;
};

}  // namespace scantet
