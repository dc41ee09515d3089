// Private: places along a Morton curve: near on the curve is near in space.
#pragma once

#include <array>
#include <cstdint>

#include "scantet/base/geometry.h"

namespace scantet {

/// The last of the steps that a coordinate has along the curve, which are counted from 0.
inline constexpr double kLastMortonStep = 2097151;

/// Interleaves the lowest 21 bits of three coordinates: bit n of steps[axis] becomes bit 3n + axis.
inline std::uint64_t interleave(const std::array<std::uint64_t, 3>& steps) {
  std::uint64_t code = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::uint64_t bits = steps[axis] & 0x1fffff;
    bits = (bits | bits << 32) & 0x1f00000000ffff;
    bits = (bits | bits << 16) & 0x1f0000ff0000ff;
    bits = (bits | bits << 8) & 0x100f00f00f00f00f;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
    bits = (bits | bits << 2) & 0x1249249249249249;
    code |= bits << axis;
  }
  return code;
}

/// The place of p, a point of the box, on the curve that fills it.
inline std::uint64_t morton_code(const Point& p, const Box& box) {
  const auto step = [&](int axis) {
    const double extent = std::max(box.extent()[axis], std::numeric_limits<double>::min());
    return static_cast<std::uint64_t>((p[axis] - box.min[axis]) / extent * kLastMortonStep);
  };
  return interleave({step(0), step(1), step(2)});
}

}  // namespace scantet
