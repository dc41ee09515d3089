// What values_at_level() counts, node by node, of any grid of heights. Around its saddle the field on a face is
// level + k u v, for k the sum of the four heights off the level; at a level moved by d its two branches are
// 2 sqrt(2 d / k) apart, in voxels.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "scantet/base/api.h"
#include "scantet/field/values_at_level.h"

namespace SCANTET_API scantet {

/// What has been found of a grid so far; counts of its parts can be added up.
class AtLevelCount {
 public:
  /// Of so many nodes: their height above the level on the inside, below it on the outside.
  void add_value(double height, std::int64_t nodes) {
    if (height > 0 && height < off_) off_ = height;
    if (height == 0) voxels_ += nodes;
  }

  /// Whether a node is a gap, and the saddles of the three faces whose least corner it is. first, size: of the box of
  /// nodes, from `first` to `size` - 1. height(x, y, z): of the node that many steps from this one, in the box.
  template <class Height>
  void add_node(const std::array<int, 3>& at, const std::array<int, 3>& first, const std::array<int, 3>& size,
                const Height& height) {
    const double here = height(0, 0, 0);
    if (here == 0) {
      gaps_ += is_gap(at, first, size, height) ? 1 : 0;
    } else {
      add_saddles(at, size, here, height);
    }
  }

  /// Of other nodes of the same grid, at the same level.
  void add(const AtLevelCount& other) {
    voxels_ += other.voxels_;
    gaps_ += other.gaps_;
    saddles_ += other.saddles_;
    heights_ += other.heights_;
    off_ = std::min(off_, other.off_);
  }

  /// Of all that was added.
  ValuesAtLevel values_at(double level, InsideSide side) const {
    return {voxels_, gaps_, saddles_, level + (side == InsideSide::above ? 1 : -1) * way_to_clear()};
  }

 private:
  /// Of the way from the level to the nearest value on the inside. No simple share: saddles between whole numbers often
  /// are half way, and there parts touch at points as they do at the level itself.
  static constexpr double kClearShare = 0.38;
  /// The same where the level itself is between values: nearer, as no voxel is at it.
  static constexpr double kMostOffSaddles = 0.24;
  /// Of the branches of the level set, voxels.
  static constexpr double kApartAtSaddles = 0.2;

  template <class Height>
  static double one_step(const Height& height, std::size_t axis, int step) {
    return height(axis == 0 ? step : 0, axis == 1 ? step : 0, axis == 2 ? step : 0);
  }

  template <class Height>
  static bool is_gap(const std::array<int, 3>& at, const std::array<int, 3>& first, const std::array<int, 3>& size,
                     const Height& height) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (at[axis] == first[axis] || at[axis] == size[axis] - 1) continue;
      if (one_step(height, axis, -1) > 0 && one_step(height, axis, 1) > 0) return true;
    }
    return false;
  }

  template <class Height>
  void add_saddles(const std::array<int, 3>& at, const std::array<int, 3>& size, double here, const Height& height) {
    std::array<double, 3> beside{};  // heights with the other sign; 0: there is none
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (at[axis] == size[axis] - 1) continue;
      const double next = one_step(height, axis, 1);
      if (here * next < 0) beside[axis] = next;
    }
    for (std::size_t a = 0; a < 2; ++a) {
      for (std::size_t b = a + 1; b < 3; ++b) {
        if (beside[a] == 0 || beside[b] == 0) continue;
        const double across = height(a == 0 ? 1 : 0, a == 1 || b == 1 ? 1 : 0, b == 2 ? 1 : 0);
        const double product = here * across;
        if (product <= 0 || !std::isfinite(product) || product != beside[a] * beside[b]) continue;
        ++saddles_;
        heights_ += std::abs(here) + std::abs(across) + std::abs(beside[a]) + std::abs(beside[b]);
      }
    }
  }

  /// From the level to a clear one, on the inside.
  double way_to_clear() const {
    if (!std::isfinite(off_)) return 0;
    if (voxels_ > 0) return kClearShare * off_;
    if (saddles_ == 0) return 0;
    const double mean = heights_ / static_cast<double>(saddles_);
    return std::min(kApartAtSaddles * kApartAtSaddles / 8 * mean, kMostOffSaddles * off_);
  }

  std::int64_t voxels_ = 0;
  std::int64_t gaps_ = 0;
  std::int64_t saddles_ = 0;
  double heights_ = 0;                                    // of the corners of those saddles, off the level, in all
  double off_ = std::numeric_limits<double>::infinity();  // of the nearest value on the inside, from the level
};

}  // namespace scantet
