// The scan's trilinear field at a level, as the verifier sees it: the values of the voxels and nothing else.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scantet/base/frame.h"
#include "scantet/field/level_settings.h"
#include "scantet/field/scan.h"
#include "scantet/verify/interval.h"

namespace scantet::verify {

/// Corners of a cell: bit 0 of the position is x, bit 1 y, bit 2 z.
using CellValues = std::array<Interval, 8>;
using Cell = std::array<int, 3>;
/// Of a voxel, in the order of the scan.
using NodeNumber = std::uint64_t;

/// Heights above the level, positive inside: (value - level), or (level - value) with InsideSide::below. Nodes have the
/// indices of voxels, and one layer around them has the outside value; cell (i, j, k) lies between nodes (i, j, k) and
/// (i + 1, j + 1, k + 1), from -1 to size - 1. The box of the field is [-1, size].
class VoxelNodes {
 public:
  /// Throws Error: input.level (as check_level()), input.range (values, a level or a frame beyond 1e50, whole numbers
  /// beyond 2^53).
  /// is_capped: the outside value is so far from the level that the level set closes within a millionth of a voxel.
  VoxelNodes(const Scan& scan, const LevelSetSettings& settings, bool is_capped = false);

  const std::array<int, 3>& size() const { return scan_.size; }
  const Frame& frame() const { return scan_.frame; }
  double level() const { return level_; }
  double side() const { return side_; }  ///< 1: inside above, -1: below
  /// The voxel's value as a double, exact.
  double value(int i, int j, int k) const;
  /// The sign of its height: 1 inside, 0 at the level.
  int sign(int i, int j, int k) const {
    const double v = value(i, j, k);
    return v == level_ ? 0 : (v > level_) == (side_ > 0) ? 1 : -1;
  }
  bool has_cell(const Cell& cell) const;
  /// Of a node in the image.
  NodeNumber number(int i, int j, int k) const {
    return (static_cast<NodeNumber>(k) * static_cast<NodeNumber>(scan_.size[1]) + static_cast<NodeNumber>(j)) *
               static_cast<NodeNumber>(scan_.size[0]) +
           static_cast<NodeNumber>(i);
  }
  /// That of the number.
  Cell node(NodeNumber number) const;

  /// Moves the nodes whose value is the level's off it, those of `inside` (ascending) into the inside and all others to
  /// the outside, and the level by a fourth of that, inward if way is 1, outward if it is -1. To be called once.
  void break_ties(std::vector<NodeNumber> inside, int way);
  /// How far they move: a 2^30th of the range of values, or what rounding asks for if that is more.
  double tie_shift() const { return shift_; }
  /// The values of a cell's corners, exact.
  std::array<double, 8> values(const Cell& cell) const;
  /// The heights of a cell's corners.
  CellValues cell(const Cell& cell) const;

 private:
  Scan scan_;
  double level_;
  double side_;
  double outside_;
  double tied_;  // the level that was asked for, if ties are broken, else no number
  double shift_;
  std::vector<NodeNumber> tied_inside_;
};

/// The map between index and world, with its errors.
class IndexMap {
 public:
  explicit IndexMap(const Frame& frame);
  IntervalVec to_index(const Point& world) const;
  /// Of a displacement.
  IntervalVec to_world(const IntervalVec& index) const;
  /// Whether the frame keeps the hand: 1 or -1.
  int handedness() const { return hand_; }
  /// The image of a world direction, to rounding.
  Vec index_direction(const Vec& world) const;

 private:
  std::array<IntervalVec, 3> columns_;
  std::array<IntervalVec, 3> rows_;
  IntervalVec origin_;
  int hand_;
};

/// Bounds of the field on a box (index coordinates) within the cell.
Interval value_range(const CellValues& corners, const Cell& cell, const Box& box);
/// Bounds of its gradient there.
IntervalVec gradient_range(const CellValues& corners, const Cell& cell, const Box& box);
/// At a point whose coordinates may be within different bounds, of the trilinear function that the cell has, continued
/// beyond it.
Interval value_at(const CellValues& corners, const Cell& cell, const Interval& x, const Interval& y, const Interval& z);

/// The field at a place (index coordinates), to rounding; the outside beyond its box.
double sampled_value(const VoxelNodes& nodes, const Vec& place);

/// The cells that a box touches, or crosses; false if a part of it is outside of the field's box.
bool cells_of(const VoxelNodes& nodes, const Box& box, Cell& first, Cell& last);
/// The part of the box in the cell. May be empty.
Box within(const Box& box, const Cell& cell);

}  // namespace scantet::verify
