// The cells of the padded grid that a segment passes, in order. All coordinates are voxel units (index space).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "scantet/base/geometry.h"

namespace scantet {

using CellIndex = std::array<int, 3>;

/// The padded index box [-1, size] of a grid, and the cells in it.
inline bool in_padded_box(const Vec& p, const std::array<int, 3>& size) {
  return p.x >= -1 && p.y >= -1 && p.z >= -1 && p.x <= size[0] && p.y <= size[1] && p.z <= size[2];
}

/// The cell that holds p, a point of the padded box. A face belongs to the cell above it, except at the end of the box.
inline CellIndex cell_of(const Vec& p, const std::array<int, 3>& size) {
  CellIndex cell;
  for (int axis = 0; axis < 3; ++axis) {
    const int truncated = static_cast<int>(p[axis]);
    cell[axis] = std::clamp(truncated - (p[axis] < truncated), -1, size[axis] - 1);
  }
  return cell;
}

/// Coordinates of p within a cell, each in [0, 1] whatever rounding did to p.
inline Vec local_in(const CellIndex& cell, const Vec& p) {
  return {std::clamp(p.x - cell[0], 0.0, 1.0), std::clamp(p.y - cell[1], 0.0, 1.0),
          std::clamp(p.z - cell[2], 0.0, 1.0)};
}

/// Cuts the segment from a to b down to the padded box. Ends that were cut lie exactly on the box. False if nothing is
/// left, or if a coordinate is not finite.
inline bool clip_to_padded_box(Vec& a, Vec& b, const std::array<int, 3>& size) {
  const Vec d = b - a;
  if (!is_finite(d)) return false;
  double enter = 0;
  double leave = 1;
  int enter_axis = -1;
  int leave_axis = -1;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = -1;
    const double high = size[axis];
    if (d[axis] == 0) {
      if (a[axis] < low || a[axis] > high) return false;
      continue;
    }
    const double near_t = ((d[axis] > 0 ? low : high) - a[axis]) / d[axis];
    const double far_t = ((d[axis] > 0 ? high : low) - a[axis]) / d[axis];
    if (near_t > enter) {
      enter = near_t;
      enter_axis = axis;
    }
    if (far_t < leave) {
      leave = far_t;
      leave_axis = axis;
    }
  }
  if (enter > leave) return false;
  const Vec source = a;
  const auto cut = [&](Vec& end, double t, int axis, bool upper) {
    end = source + t * d;
    for (int other = 0; other < 3; ++other) end[other] = std::clamp(end[other], -1.0, double(size[other]));
    end[axis] = upper ? size[axis] : -1;
  };
  if (leave_axis >= 0) cut(b, leave, leave_axis, d[leave_axis] > 0);
  if (enter_axis >= 0) cut(a, enter, enter_axis, d[enter_axis] < 0);
  return true;
}

/// Walks from cell to cell (3D DDA). Each step moves whole cells in the direction of the segment, by integers, and
/// every plane's parameter is computed afresh: no error builds up, and the walk ends whatever rounding does. A step
/// through an edge or a node goes straight to the cell across.
class CellWalk {
 public:
  /// from, to: in the padded box of a grid of `size`.
  CellWalk(const Vec& from, const Vec& to, const std::array<int, 3>& size)
      : from_(from), to_(to), direction_(to - from), size_(size), cell_(cell_of(from, size)), entry_(from) {
    constexpr double kStandsStill = 1e-200;  // its inverse would overflow against a coordinate
    for (int axis = 0; axis < 3; ++axis) {
      const double d = direction_[axis];
      step_[axis] = d > kStandsStill ? 1 : d < -kStandsStill ? -1 : 0;
      inverse_[axis] = step_[axis] == 0 ? 0 : 1 / d;
    }
  }

  const CellIndex& cell() const { return cell_; }
  const Vec& entry() const { return entry_; }  ///< where the segment enters the current cell
  const Vec& exit() const { return exit_; }    ///< where it leaves what find_exit() was asked for
  bool last() const { return last_; }          ///< after find_exit(): the segment ends before leaving

  /// Finds where the segment leaves the block of 2^shift cells a side that holds the current cell (0: the cell itself).
  void find_exit(int shift) {
    Vec plane_t{2, 2, 2};
    std::array<int, 3> plane{};
    for (int axis = 0; axis < 3; ++axis) {
      if (step_[axis] == 0) continue;
      const int block = (cell_[axis] + 1) >> shift;
      plane[axis] = ((block + (step_[axis] > 0)) << shift) - 1;
      plane_t[axis] = (plane[axis] - from_[axis]) * inverse_[axis];
    }
    const double first = std::min({plane_t.x, plane_t.y, plane_t.z});
    const double t = std::max(first, t_);
    next_ = cell_;
    last_ = t >= 1;
    if (!last_) {
      exit_ = from_ + t * direction_;
      for (int axis = 0; axis < 3; ++axis) enter_next(axis, shift, plane[axis], plane_t[axis] == first);
      t_ = t;
    }
    if (last_) exit_ = to_;
  }

  /// Goes on to the cell behind exit().
  void advance() {
    cell_ = next_;
    entry_ = exit_;
  }

 private:
  void enter_next(int axis, int shift, int plane, bool through_plane) {
    if (step_[axis] == 0) return;
    if (through_plane) {
      exit_[axis] = plane;
      next_[axis] = step_[axis] > 0 ? plane : plane - 1;
      last_ = last_ || next_[axis] < -1 || next_[axis] >= size_[axis];
    } else if (shift > 0) {
      const int truncated = static_cast<int>(exit_[axis]);
      const int floor = truncated - (exit_[axis] < truncated);
      const int block_end = std::min(step_[axis] > 0 ? plane - 1 : plane, size_[axis] - 1);
      next_[axis] =
          step_[axis] > 0 ? std::clamp(floor, cell_[axis], block_end) : std::clamp(floor, block_end, cell_[axis]);
    }
  }

  Vec from_;
  Vec to_;
  Vec direction_;
  std::array<int, 3> size_;
  CellIndex cell_;
  CellIndex next_{};
  Vec entry_;
  Vec exit_;
  Vec inverse_;
  std::array<int, 3> step_{};
  double t_ = 0;
  bool last_ = false;
};

}  // namespace scantet
