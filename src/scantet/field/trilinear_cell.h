// The trilinear map of one cell: at a point, and as a cubic along a segment.
#pragma once

#include <array>
#include <bit>
#include <cmath>

#include "scantet/base/api.h"
#include "scantet/base/geometry.h"
#include "scantet/field/bernstein_cubic.h"

namespace SCANTET_API scantet {

/// Heights at a cell's corners; bit 0 of the position is x, bit 1 y, bit 2 z.
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

/// Heights at the corners of a box in the cell, from local coordinates `low` to `high`, each in [0, 1]: in that box the
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

/// The trilinear map of a box as an affine one and what it is off from that at the most.
class AffineBounds {
 public:
  explicit AffineBounds(const CellHeights& h) {  ///< of this cell, in its own coordinates
    const auto sum = [&](int signs) {            // bit n: minus where an odd number of the bits it has are clear
      double total = 0;
      for (int c = 0; c < 8; ++c) total += (std::popcount(static_cast<unsigned>(signs & ~c)) & 1) != 0 ? -h[c] : h[c];
      return total / 8;
    };
    mean_ = sum(0);
    slope_ = {sum(1), sum(2), sum(4)};
    bent_ = std::abs(sum(3)) + std::abs(sum(5)) + std::abs(sum(6)) + std::abs(sum(7));
  }
  /// The affine map; u: local coordinates in the box, 0 to 1, or beyond.
  double affine_at(const Vec& u) const { return mean_ + dot(slope_, 2 * u - Vec{1, 1, 1}); }
  /// What the height is off from it at the most, in the box.
  double bent() const { return bent_; }

 private:
  double mean_;
  Vec slope_;
  double bent_;
};

/// Height along the segment from a to b (local coordinates in [0, 1]). The coefficients come from the polar form of the
/// trilinear map, so they are averages of heights inside the cell. The first equals trilinear(h, a), the last
/// trilinear(h, b).
inline BernsteinCubic heights_along(const CellHeights& h, const Vec& a, const Vec& b) {
  const auto at_x = [&h](double u) {
    return std::array{mix(h[0], h[1], u), mix(h[2], h[3], u), mix(h[4], h[5], u), mix(h[6], h[7], u)};
  };
  const auto at_y = [](const std::array<double, 4>& e, double u) {
    return std::array{mix(e[0], e[1], u), mix(e[2], e[3], u)};
  };
  const auto at_z = [](const std::array<double, 2>& e, double u) { return mix(e[0], e[1], u); };
  const std::array<double, 4> xa = at_x(a.x);
  const std::array<double, 4> xb = at_x(b.x);
  const std::array<double, 2> aa = at_y(xa, a.y);
  const std::array<double, 2> ab = at_y(xa, b.y);
  const std::array<double, 2> ba = at_y(xb, a.y);
  const std::array<double, 2> bb = at_y(xb, b.y);
  return {at_z(aa, a.z), (at_z(ba, a.z) + at_z(ab, a.z) + at_z(aa, b.z)) / 3,
          (at_z(ab, b.z) + at_z(ba, b.z) + at_z(bb, a.z)) / 3, at_z(bb, b.z)};
}

}  // namespace scantet
