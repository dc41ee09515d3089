// The cells of the padded grid that a segment passes, in order. All coordinates are voxel units (index space).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "scantet/base/api.h"
#include "scantet/base/box_clip.h"

namespace SCANTET_API scantet {

/// A cell, by the index of its low corner: from -1 to size - 1 along each axis, as the grid is padded by one node.
using CellIndex = std::array<int, 3>;

/// Whether p is in the padded index box [-1, size] of a grid, its faces included. size: nodes along each axis, without
/// the padding, here and below.
inline bool in_padded_box(const Vec& p, const std::array<int, 3>& size) {
  return p.x >= -1 && p.y >= -1 && p.z >= -1 && p.x <= size[0] && p.y <= size[1] && p.z <= size[2];
}

/// The largest integer that is not above x, which must be within the range of an int.
inline int floored(double x) {
  const int truncated = static_cast<int>(x);
  return truncated - (x < truncated);
}

/// The cell that holds p, a point of the padded box. A face belongs to the cell above it, except at the end of the box.
inline CellIndex cell_of(const Vec& p, const std::array<int, 3>& size) {
  CellIndex cell;
  for (int axis = 0; axis < 3; ++axis) cell[axis] = std::clamp(floored(p[axis]), -1, size[axis] - 1);
  return cell;
}

/// Coordinates of p within a cell, each in [0, 1] whatever rounding did to p.
inline Vec local_in(const CellIndex& cell, const Vec& p) {
  return {std::clamp(p.x - cell[0], 0.0, 1.0), std::clamp(p.y - cell[1], 0.0, 1.0),
          std::clamp(p.z - cell[2], 0.0, 1.0)};
}

/// Cuts the segment from a to b down to the padded box. Ends that were cut lie exactly on the box. Return: false, and
/// the ends stay as they are, if nothing is left, or if a coordinate of b - a is not finite.
inline bool clip_to_padded_box(Vec& a, Vec& b, const std::array<int, 3>& size) {
  const Vec d = b - a;
  if (!is_finite(d)) return false;
  const Box box{{-1, -1, -1}, {double(size[0]), double(size[1]), double(size[2])}};
  const auto stretch = clip_to_box(a, d, box);
  if (!stretch) return false;
  const Vec source = a;
  const auto cut = [&](Vec& end, double t, int axis, bool upper) {
    end = source + t * d;
    for (int other = 0; other < 3; ++other) end[other] = std::clamp(end[other], box.min[other], box.max[other]);
    end[axis] = (upper ? box.max : box.min)[axis];
  };
  if (stretch->leave_axis >= 0) cut(b, stretch->leave, stretch->leave_axis, d[stretch->leave_axis] > 0);
  if (stretch->enter_axis >= 0) cut(a, stretch->enter, stretch->enter_axis, d[stretch->enter_axis] < 0);
  return true;
}

/// Walks from cell to cell (3D DDA). Each step moves whole cells in the direction of the segment, by integers, and
/// every plane's parameter is computed afresh: no error builds up, and the walk ends whatever rounding does. A step
/// through an edge or a node goes straight to the cell across. Points are worked out only when asked for.
///
/// In turn: find_exit() or find_exit_of_block(); then entry(), exit() and last(); and unless it is the last, advance().
class CellWalk {
 public:
  /// Begins in the cell that holds `from`. from, to: in the padded box of a grid of `size`.
  CellWalk(const Vec& from, const Vec& to, const std::array<int, 3>& size)
      : from_(from), to_(to), direction_(to - from), size_(size), cell_(cell_of(from, size)) {
    constexpr double kStandsStill = 1e-200;  // its inverse would overflow against a coordinate
    for (int axis = 0; axis < 3; ++axis) {
      const double d = direction_[axis];
      step_[axis] = d > kStandsStill ? 1 : d < -kStandsStill ? -1 : 0;
      inverse_[axis] = step_[axis] == 0 ? 0 : 1 / d;
      plane_t_[axis] = plane_t(axis, cell_[axis] + (step_[axis] > 0));
    }
  }

  const CellIndex& cell() const { return cell_; }           ///< the one that the walk has come to
  Vec entry() const { return point(t_, through_, cell_); }  ///< where the segment enters the current cell
  /// Where it leaves the cell, or the block, whose exit was found last; its end if it does not.
  Vec exit() const { return last_ ? to_ : point(next_t_, next_through_, next_); }
  bool last() const { return last_; }  ///< whether the segment ends before it leaves that, or leaves the box there

  /// Finds where the segment leaves the current cell.
  void find_exit() {
    find_exit(plane_t_);
    if (last_) return;
    next_ = cell_;
    for (int axis = 0; axis < 3; ++axis) {
      if (next_through_ >> axis & 1) next_[axis] += step_[axis];
    }
    end_beyond_box();
  }

  /// Finds where the segment leaves the block of 2^shift cells a side that holds the current cell (block_signs.h).
  void find_exit_of_block(int shift) {
    std::array<double, 3> t;
    CellIndex last_of_block;  // the cell beside the plane
    for (int axis = 0; axis < 3; ++axis) {
      const int block = (cell_[axis] + 1) >> shift;
      const int plane = ((block + (step_[axis] > 0)) << shift) - 1;
      t[axis] = plane_t(axis, plane);
      last_of_block[axis] = step_[axis] > 0 ? plane - 1 : plane;
    }
    find_exit(t);
    if (last_) return;
    next_ = cell_;
    for (int axis = 0; axis < 3; ++axis) {
      if (step_[axis] == 0) continue;
      if (next_through_ >> axis & 1) {
        next_[axis] = last_of_block[axis] + step_[axis];
        continue;
      }
      const int there = floored(from_[axis] + next_t_ * direction_[axis]);
      const int end = std::min(last_of_block[axis], size_[axis] - 1);
      next_[axis] = step_[axis] > 0 ? std::clamp(there, cell_[axis], end) : std::clamp(there, end, cell_[axis]);
    }
    end_beyond_box();
  }

  /// Goes on to the cell behind exit(). Pre: not last().
  void advance() {
    for (int axis = 0; axis < 3; ++axis) {
      if (next_[axis] != cell_[axis]) plane_t_[axis] = plane_t(axis, next_[axis] + (step_[axis] > 0));
    }
    cell_ = next_;
    t_ = next_t_;
    through_ = next_through_;
  }

 private:
  /// Where the line meets a plane across the axis; beyond the end if it never does.
  double plane_t(int axis, int plane) const { return step_[axis] == 0 ? 2 : (plane - from_[axis]) * inverse_[axis]; }
  /// Where the line is in the cell at t, having come through the cell's sides across the axes in `through`.
  Vec point(double t, unsigned through, const CellIndex& cell) const {
    Vec p = from_ + t * direction_;
    for (int axis = 0; axis < 3; ++axis) {
      if (through >> axis & 1) p[axis] = cell[axis] + (step_[axis] < 0);
    }
    return p;
  }
  void find_exit(const std::array<double, 3>& plane_t) {
    const double first = std::min({plane_t[0], plane_t[1], plane_t[2]});
    next_t_ = std::max(first, t_);
    last_ = next_t_ >= 1;
    next_through_ = 0;
    for (int axis = 0; axis < 3; ++axis) next_through_ |= static_cast<unsigned>(plane_t[axis] == first) << axis;
  }
  void end_beyond_box() {
    for (int axis = 0; axis < 3; ++axis) last_ = last_ || next_[axis] < -1 || next_[axis] >= size_[axis];
  }

  Vec from_;
  Vec to_;
  Vec direction_;
  Vec inverse_;
  std::array<int, 3> size_;
  std::array<int, 3> step_{};
  CellIndex cell_;
  CellIndex next_{};
  std::array<double, 3> plane_t_{};  // of the planes where the line would leave the cell
  double t_ = 0;
  double next_t_ = 0;
  unsigned through_ = 0;  // bit `axis`: the cell was entered through a plane across the axis
  unsigned next_through_ = 0;
  bool last_ = false;
};

}  // namespace scantet
