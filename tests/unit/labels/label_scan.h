// Segmentations for tests: label maps from functions, in several frames.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "scantet/field/scan_from_memory.h"
#include "scantet/labels/label_field.h"
#include "unit/frames.h"

namespace scantet::test {

/// label(i, j, k) at each voxel.
template <class Voxel = std::uint16_t, class Label>
Scan label_scan(const std::array<int, 3>& size, const Label& label, const Frame& frame = {}) {
  std::vector<Voxel> values;
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) values.push_back(static_cast<Voxel>(label(i, j, k)));
    }
  }
  return make_scan(std::move(values), size, frame);
}

/// A quarter of the nodes background, the others of the labels 1 to `labels`, each by chance.
inline Scan label_noise(const std::array<int, 3>& size, int labels, const Frame& frame = {}, unsigned seed = 3) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> chance(0, 4 * labels - 1);
  return label_scan(
      size,
      [&](int, int, int) {
        const int n = chance(random);
        return n < labels ? 0 : 1 + n % labels;
      },
      frame);
}

/// The cells of the sites nearest by, within a ball; some of its parts are larger than blocks of 8³ cells.
inline Scan label_cells(const std::array<int, 3>& size, int sites, const Frame& frame = {}, unsigned seed = 5) {
  std::mt19937 random(seed);
  const Vec extent{size[0] - 1.0, size[1] - 1.0, size[2] - 1.0};
  std::vector<Vec> at;
  for (int n = 0; n < sites; ++n) {
    Vec p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = std::uniform_real_distribution<double>(0, extent[axis])(random);
    at.push_back(p);
  }
  return label_scan(
      size,
      [&](int i, int j, int k) {
        const Vec p{double(i), double(j), double(k)};
        const double radius = 0.5 * std::min({extent.x, extent.y, extent.z});
        if (distance(p, 0.5 * extent) > radius) return 0;
        const auto nearest = std::min_element(at.begin(), at.end(), [&](const Vec& a, const Vec& b) {
          return squared_distance(a, p) < squared_distance(b, p);
        });
        return 1 + static_cast<int>(nearest - at.begin());
      },
      frame);
}

inline std::shared_ptr<const LabelField> smooth_field(const Scan& scan) {
  LabelSettings settings;
  settings.smoothing = LabelSmoothing::keep;
  return make_label_field(scan, settings);
}

}  // namespace scantet::test
