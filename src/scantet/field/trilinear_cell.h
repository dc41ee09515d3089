// The trilinear map of one cell as a cubic along a segment.
#pragma once

#include <array>

#include "scantet/base/api.h"
#include "scantet/base/trilinear.h"
#include "scantet/field/bernstein_cubic.h"

namespace SCANTET_API scantet {

/// Height along the segment from a (t = 0) to b (t = 1), local coordinates in [0, 1]. h: at the corners of the cell.
/// The coefficients come from the polar form of the trilinear map, so they are averages of heights inside the cell. The
/// first equals trilinear(h, a), the last trilinear(h, b).
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
