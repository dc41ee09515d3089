// A component of a level set while it is measured.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "scantet/base/frame.h"
#include "scantet/domain/domain.h"
#include "scantet/field/height_grid.h"

namespace scantet {

/// A component while it is measured.
class Measure {
 public:
  using NodeIndex = std::array<int, 3>;

  std::int64_t nodes = 0;
  double extreme = 0;
  NodeIndex witness{};
  NodeIndex low{};
  NodeIndex high{};
  bool inside = false;
  bool touches_border = false;
  std::int64_t eighths = 0;  ///< of its Euler number, eight times that

  void add(const HeightGrid& heights, int begin, int end, int j, int k, bool is_inside) {
    const NodeIndex first{begin, j, k};
    const NodeIndex last{end - 1, j, k};
    const HeightGrid::Extreme found = heights.extreme(begin, end, j, k, is_inside);
    const NodeIndex candidate{found.i, j, k};
    const bool better = is_inside ? found.height > extreme : found.height < extreme;
    if (nodes == 0 || better || (found.height == extreme && candidate < witness)) {
      extreme = found.height;
      witness = candidate;
    }
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = nodes == 0 ? first[axis] : std::min(low[axis], first[axis]);
      high[axis] = nodes == 0 ? last[axis] : std::max(high[axis], last[axis]);
      touches_border = touches_border || first[axis] == 0 || last[axis] + 1 == heights.size()[axis];
    }
    nodes += end - begin;
    inside = is_inside;
  }

  /// Takes in another part of the same component.
  void merge(const Measure& other) {
    const std::int64_t sum = eighths + other.eighths;
    if (nodes == 0) {
      *this = other;
    } else if (other.nodes > 0) {
      merge_nodes(other);
    }
    eighths = sum;
  }

  Component component(const Frame& frame) const {
    const auto point = [](const NodeIndex& node) { return Vec{double(node[0]), double(node[1]), double(node[2])}; };
    Component made;
    made.region = inside ? 1 : kOutside;
    made.witness = frame.to_world(point(witness));
    made.box_mm = frame.world_box(point(low), point(high));
    made.volume_mm3 = static_cast<double>(nodes) * std::abs(frame.determinant_mm3());
    made.touches_border = touches_border;
    return made;
  }

 private:
  void merge_nodes(const Measure& other) {
    const bool better = inside ? other.extreme > extreme : other.extreme < extreme;
    if (better || (other.extreme == extreme && other.witness < witness)) {
      extreme = other.extreme;
      witness = other.witness;
    }
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], other.low[axis]);
      high[axis] = std::max(high[axis], other.high[axis]);
    }
    touches_border = touches_border || other.touches_border;
    nodes += other.nodes;
  }
};

}  // namespace scantet
