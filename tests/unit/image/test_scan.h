// Scans made of arrays and arithmetic, for tests of the image module.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "scantet/field/scan.h"

namespace scantet::test {

/// Of scans whose axes must not be taken for each other.
inline constexpr std::array<int, 3> kSize{37, 26, 19};

/// A scan that owns `values` (x fastest), with the range worked out.
template <class Voxel>
Scan scan_of(const std::array<int, 3>& size, std::vector<Voxel> values, const Frame& frame = {}) {
  const auto owner = std::make_shared<const std::vector<Voxel>>(std::move(values));
  const auto [least, most] = std::minmax_element(owner->begin(), owner->end());
  Scan scan;
  scan.size = size;
  scan.frame = frame;
  scan.voxels = owner->data();
  scan.owner = owner;
  scan.min_value = static_cast<double>(*least);
  scan.max_value = static_cast<double>(*most);
  return scan;
}

/// A scan of value(i, j, k) at each voxel, converted to Voxel.
template <class Voxel, class Value>
Scan scan_of_function(const std::array<int, 3>& size, const Value& value, const Frame& frame = {}) {
  std::vector<Voxel> values;
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) values.push_back(static_cast<Voxel>(value(i, j, k)));
    }
  }
  return scan_of(size, std::move(values), frame);
}

/// A noisy ball, about 0 … 100 with level 50 in the middle: noise at its surface, quiet inside and outside, so that
/// some blocks of cells are mixed and some are not.
template <class Voxel>
Scan noisy_ball(const std::array<int, 3>& size, const Frame& frame, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-35, 35);
  return scan_of_function<Voxel>(
      size,
      [&](int i, int j, int k) {
        const double x = 2.0 * i / (size[0] - 1) - 1;
        const double y = 2.0 * j / (size[1] - 1) - 1;
        const double z = 2.0 * k / (size[2] - 1) - 1;
        const double ball = 50 + 300 * (0.7 - std::sqrt(x * x + y * y + z * z));
        return std::clamp(ball + noise(random), 0.0, 100.0);
      },
      frame);
}

/// Noise of the whole numbers from 0 to 3: a quarter of the nodes lie exactly at the level 1.
template <class Voxel>
Scan plateaus(const std::array<int, 3>& size, const Frame& frame, unsigned seed = 2) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> value(0, 3);
  return scan_of_function<Voxel>(
      size, [&](int, int, int) { return value(random); }, frame);
}

struct NamedFrame {
  std::string name;
  Frame frame;
};

/// Axis-aligned, anisotropic, oblique, flipped and sheared frames, the last four with origins some 500 mm away.
inline std::vector<NamedFrame> frames() {
  const double c = std::cos(0.6);
  const double s = std::sin(0.6);
  const double c2 = std::cos(-1.1);
  const double s2 = std::sin(-1.1);
  const Vec u{c, s * c2, s * s2};
  const Vec v{-s, c * c2, c * s2};
  const Vec w{0, -s2, c2};
  return {{"axis_aligned", Frame()},
          {"anisotropic", Frame({Vec{0.5, 0, 0}, Vec{0, 0.7, 0}, Vec{0, 0, 3}}, {-512.3, 431.7, 655.1})},
          {"oblique", Frame({0.6 * u, 0.6 * v, 1.25 * w}, {498.6, -502.2, 377.9})},
          {"flipped", Frame({Vec{-0.8, 0, 0}, Vec{0, 0, 1.1}, Vec{0, 0.9, 0}}, {500, 500, -500})},
          {"sheared", Frame({0.9 * u, 0.9 * v + 0.4 * u, 1.5 * w - 0.3 * v}, {-480.5, 510.25, 533.3})}};
}

/// A point of the index box [low, size - 1 - low], uniformly.
inline Vec random_index(const std::array<int, 3>& size, std::mt19937& random, double low = -1) {
  Vec p;
  for (int axis = 0; axis < 3; ++axis) {
    p[axis] = std::uniform_real_distribution<double>(low, size[axis] - 1 - low)(random);
  }
  return p;
}

/// A direction, uniformly.
inline Vec random_direction(std::mt19937& random) {
  const double z = std::uniform_real_distribution<double>(-1, 1)(random);
  const double angle = std::uniform_real_distribution<double>(0, 2 * std::numbers::pi)(random);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

}  // namespace scantet::test
