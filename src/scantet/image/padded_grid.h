// The scan as a grid of heights above the level, with one layer of outside nodes around it that is never stored.
#pragma once

#include <array>
#include <cstdint>

#include "scantet/image/level_set.h"

namespace scantet {

/// Height of a node: (value - level), negated when the inside is below; inside is height > 0.
/// Node indices run from -1 to size along each axis (the two ends are the padding); cell (i, j, k) has its low corner
/// at node (i, j, k), so cell indices run from -1 to size - 1.
template <class Voxel>
struct PaddedGrid {
  const Voxel* voxels = nullptr;
  std::array<int, 3> size{};
  double level = 0;
  double sign = 1;             ///< +1: inside above, -1: inside below
  double outside_height = -1;  ///< of the padding, ≤ 0

  double height(int i, int j, int k) const {
    if (static_cast<unsigned>(i) >= static_cast<unsigned>(size[0]) ||
        static_cast<unsigned>(j) >= static_cast<unsigned>(size[1]) ||
        static_cast<unsigned>(k) >= static_cast<unsigned>(size[2])) {
      return outside_height;
    }
    return sign * (static_cast<double>(voxels[offset(i, j, k)]) - level);
  }
  std::int64_t offset(int i, int j, int k) const { return (std::int64_t{k} * size[1] + j) * size[0] + i; }

  /// Heights of a cell's corners; bit 0 of the position is x, bit 1 y, bit 2 z.
  std::array<double, 8> corners(int i, int j, int k) const {
    std::array<double, 8> h;
    if (i >= 0 && j >= 0 && k >= 0 && i + 1 < size[0] && j + 1 < size[1] && k + 1 < size[2]) {
      const Voxel* v = voxels + offset(i, j, k);
      const std::int64_t dy = size[0];
      const std::int64_t dz = dy * size[1];
      const Voxel raw[8] = {v[0], v[1], v[dy], v[dy + 1], v[dz], v[dz + 1], v[dz + dy], v[dz + dy + 1]};
      for (int c = 0; c < 8; ++c) h[c] = sign * (static_cast<double>(raw[c]) - level);
    } else {
      for (int c = 0; c < 8; ++c) h[c] = height(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
    }
    return h;
  }
};

/// The grid of a scan at a level. The outside height is never above zero.
template <class Voxel>
PaddedGrid<Voxel> padded_grid(const Scan& scan, const Voxel* voxels, const LevelSetSettings& settings) {
  const double sign = settings.inside == InsideSide::above ? 1 : -1;
  const double outside =
      settings.outside.value_or(settings.inside == InsideSide::above ? scan.min_value : scan.max_value);
  return {voxels, scan.size, settings.level, sign, sign * (outside - settings.level)};
}

}  // namespace scantet
