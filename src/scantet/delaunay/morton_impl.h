// Private: places along a Morton curve: near on the curve is near in space.
#pragma once

#include <cstdint>

#include "scantet/base/geometry.h"

namespace scantet::engine {

/// Interleaves 21 bits of each coordinate of p, a point of the box.
inline std::uint64_t morton_code(const Point& p, const Box& box) {
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = std::max(box.extent()[axis], std::numeric_limits<double>::min());
    auto bits = static_cast<std::uint64_t>((p[axis] - box.min[axis]) / extent * 2097151.0);
    bits = (bits | bits << 32) & 0x1f00000000ffffULL;
    bits = (bits | bits << 16) & 0x1f0000ff0000ffULL;
    bits = (bits | bits << 8) & 0x100f00f00f00f00fULL;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3ULL;
    bits = (bits | bits << 2) & 0x1249249249249249ULL;
    code |= bits << axis;
  }
  return code;
}

}  // namespace scantet::engine
