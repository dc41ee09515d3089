// What is known of a formula before a question is asked, cube by cube.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "formula.h"
#include "scantet/base/progress.h"
#include "scantet/domain/clearance_grid.h"

namespace implicit {

/// What a formula comes to in a cube, by the mean value theorem: between low and high at `center`, and from there on by
/// `least` to `most` a mm along each axis. Plain numbers, so that a model is less than a line of the cache.
struct alignas(64) CubeModel {
  std::array<float, 3> center;  ///< of the expansion, mm
  float low, high;
  std::array<float, 3> least, most;

  /// The values at p, a point of the cube. Along a segment in the cube, its lower end is a concave function of the
  /// place and its upper end a convex one.
  Interval values_at(const scantet::Point& p) const {
    const scantet::Vec d{p.x - center[0], p.y - center[1], p.z - center[2]};
    const Interval change = change_along(d);
    return {low + change.lo, high + change.hi};
  }
  /// What `along` adds to the value between two points of the cube, that vector apart.
  Interval change_along(const scantet::Vec& along) const {
    Interval change{0, 0};
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      const double p = least[i] * along[axis];
      const double q = most[i] * along[axis];
      change.lo += std::min(p, q);
      change.hi += std::max(p, q);
    }
    return change;
  }
};

/// The cubes of a box in which the formula keeps its sign, on doubles: inside is where it is negative. A model of every
/// other one. Immutable, so safe to use from many threads.
class FormulaGrid {
 public:
  FormulaGrid() = default;
  /// Nothing may be asked of it once progress.cancelled() became true.
  FormulaGrid(const Formula& formula, const scantet::Box& box, const scantet::Progress& progress = scantet::Progress());

  const scantet::ClearanceGrid& clear() const { return clear_; }
  /// cube: the index of one that is not clear. Where the formula cannot be bounded, the model's numbers are infinite,
  /// and what it gives excludes nothing (it may be NaN).
  const CubeModel& model(std::size_t cube) const {
    const Stretch& stretch = stretches_[cube / kStretch];
    const std::uint64_t before = (std::uint64_t{1} << cube % kStretch) - 1;
    return models_[stretch.first + static_cast<std::size_t>(std::popcount(stretch.near & before))];
  }

 private:
  static constexpr std::size_t kStretch = 64;
  struct Stretch {
    std::uint64_t near = 0;   // a bit for each of kStretch cubes: whether it has a model
    std::uint32_t first = 0;  // of their models
  };

  scantet::ClearanceGrid clear_;
  std::vector<Stretch> stretches_;
  std::vector<CubeModel> models_;
};

}  // namespace implicit
