// The scan as a grid of heights above the level, with one layer of outside nodes around it that is never stored.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "scantet/field/level_settings.h"
#include "scantet/field/scan.h"

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

  /// Which nodes of a row are inside: node i is bit i + 1 (so that the padding has its bits, always clear).
  /// words: room for row_words() of them; all are set. j, k: any.
  void row_signs(int j, int k, std::uint64_t* words) const {
    std::fill_n(words, row_words(), 0);
    if (j < 0 || j >= size[1] || k < 0 || k >= size[2]) return;
    const Voxel* row = voxels + offset(0, j, k);
    for (int begin = 0; begin < size[0]; begin += 64) {
      const std::uint64_t bits = signs_of(row + begin, std::min(64, size[0] - begin));
      words[begin / 64] |= bits << 1;
      if (bits >> 63) words[begin / 64 + 1] |= 1;
    }
  }
  int row_words() const { return (size[0] + 2 + 63) / 64; }

  /// Which nodes of a row are at the level itself, as row_signs() says which are inside. Return: whether any is; if
  /// not, the words are left as they are.
  bool row_zeros(int j, int k, std::uint64_t* words) const {
    if (j < 0 || j >= size[1] || k < 0 || k >= size[2]) return false;
    if (std::is_integral_v<Voxel> && level != std::floor(level)) return false;
    const Voxel* row = voxels + offset(0, j, k);
    int zeros = 0;
    for (int i = 0; i < size[0]; ++i) zeros += static_cast<double>(row[i]) == level;
    if (zeros == 0) return false;
    std::fill_n(words, row_words(), 0);
    for (int i = 0; i < size[0]; ++i) {
      if (static_cast<double>(row[i]) == level) words[(i + 1) / 64] |= std::uint64_t{1} << (i + 1) % 64;
    }
    return true;
  }

  template <class Number>
  void mark_inside(const Voxel* values, int count, Number bound, std::array<bool, 64>& inside) const {
    if (sign > 0) {
      for (int n = 0; n < count; ++n) inside[n] = static_cast<Number>(values[n]) > bound;
    } else {
      for (int n = 0; n < count; ++n) inside[n] = static_cast<Number>(values[n]) < bound;
    }
  }

  /// Bit n is set if values[n] is inside; count ≤ 64. The same as height > 0: a difference of two doubles has the sign
  /// of their comparison.
  std::uint64_t signs_of(const Voxel* values, int count) const {
    std::array<bool, 64> inside{};  // in a loop of its own, which compilers vectorize
    if constexpr (std::is_integral_v<Voxel> && sizeof(Voxel) <= 2) {
      // A whole number is above the level just where it is above the largest whole number that is not.
      const double rounded = sign > 0 ? std::floor(level) : std::ceil(level);
      mark_inside(values, count, static_cast<int>(std::clamp(rounded, -1e6, 1e6)), inside);
    } else {
      mark_inside(values, count, level, inside);
    }
    std::uint64_t bits = 0;
    for (int n = 0; n < 64; n += 8) {
      std::uint64_t eight = 0;
      for (int m = 0; m < 8; ++m) eight |= std::uint64_t{inside[n + m]} << 8 * m;
      bits |= eight * 0x0102040810204080 >> 56 << n;  // byte m's lowest bit comes to be bit m
    }
    return bits;
  }

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
