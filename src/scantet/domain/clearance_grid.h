// Where a boundary is not: the first question of a domain whose own queries are dear.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/geometry.h"

namespace SCANTET_API scantet {

/// Equal cubes that cover a box, in rows along x, then y, then z.
struct CubeGrid {
  Point origin;                 ///< the corner with the least coordinates, world mm
  double edge_mm = 0;           ///< of each cube; > 0, unless there are none
  std::array<int, 3> counts{};  ///< cubes along each axis

  /// No cubes.
  CubeGrid() = default;
  /// box: world mm. along_longest: cubes along its longest edge, from 1 on; there are fewer where coordinates are so
  /// large that cubes would be lost in their rounding. Along the other axes: as many as cover it, at least one.
  /// Pre: the box is finite, not empty, and not the origin alone.
  CubeGrid(const Box& box, int along_longest);

  /// How many cubes there are.
  std::size_t size() const { return static_cast<std::size_t>(counts[0]) * counts[1] * counts[2]; }
  /// The place of a cube in a list of all, x fastest. cube: its index along each axis, from 0 to counts - 1.
  std::size_t index(const std::array<int, 3>& cube) const {
    return (static_cast<std::size_t>(cube[2]) * counts[1] + cube[1]) * counts[0] + cube[0];
  }
  /// The centre of a cube, world mm.
  Point center(const std::array<int, 3>& cube) const;
  /// The box of the cubes from `first` to `last`, both of them included, world mm, enlarged each way by kSlack of an
  /// edge: more than rounding can mistake the cube of a point by.
  Box enlarged(const std::array<int, 3>& first, const std::array<int, 3>& last) const;
  /// The first and the last of the cubes that, enlarged, meet the box, world mm; one more each way may be among them.
  /// Of a box beyond the grid: those at the grid's end that are nearest to it. Pre: the box is not empty.
  std::array<std::array<int, 3>, 2> range(const Box& box) const;

  static constexpr double kSlack = 1e-6;  ///< of an edge
};

/// What is known of a cube. It is clear if the boundary does not meet it, enlarged as above. near: it may not be clear;
/// outside, inside: it is clear, and out of the object or in it.
enum class CubeState : std::uint8_t { near, outside, inside };

/// Asks state_of(box) for blocks of up to 16 cubes a side, and for their halves as long as the answer is `near`.
/// state_of: is called from several threads at once, with boxes in world mm, enlarged as above; `near` is always
/// allowed, the others must be true of every point of the box. What it throws is thrown here.
/// Return: the state of each cube, in the order of CubeGrid::index(). It does not depend on the number of threads.
std::vector<CubeState> find_states(const CubeGrid& grid, const std::function<CubeState(const Box&)>& state_of);

/// The states of a grid's cubes, made ready for questions. Immutable, so safe to use from many threads.
class ClearanceGrid {
 public:
  /// No cubes: at() says outside of every point, and walk() must not be called.
  ClearanceGrid() = default;
  /// states: of every cube, in the order of CubeGrid::index(). Beyond the grid is outside.
  ClearanceGrid(const CubeGrid& grid, const std::vector<CubeState>& states);

  /// As it was given.
  const CubeGrid& grid() const { return grid_; }

  /// What is known where a point is.
  struct Place {
    CubeState state = CubeState::outside;
    std::array<int, 3> cube{};  ///< its index along each axis; it says nothing if the point is beyond the grid
  };
  /// The cube that holds p, world mm, and its state: outside beyond the grid.
  Place at(const Point& p) const;

  /// Calls near(cube, begin, end) for each cube on the segment that is not clear, from its source on: from begin to
  /// end, as shares of the segment's length, it passes that cube. Whatever part of the segment is in none of these
  /// stretches is clear. A cube is its CubeGrid::index(), a std::size_t. segment: world mm; it should not be longer
  /// than a thousand grids. Pre: its ends are finite.
  template <class Near>
  void walk(const Segment& segment, const Near& near) const;

 private:
  /// A cube in a byte: 0 if near; else 2 · level + 1 (outside) or + 2 (inside), where the block of 2^level cubes a
  /// side that holds it is clear, each block at a multiple of its size.
  static constexpr int kHighestLevel = 6;
  using Code = std::uint8_t;

  /// The stretch of the segment from + t · along, in cubes, that is in the grid; false if there is none. begin, end: 0
  /// and 1 before.
  bool clip(const std::array<double, 3>& from, const std::array<double, 3>& along, double& begin, double& end) const {
    bool held = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const double to = from[i] + along[i];
      held = held && from[i] >= 0 && from[i] <= grid_.counts[i] && to >= 0 && to <= grid_.counts[i];
    }
    return held || cut(from, along, begin, end);
  }
  bool cut(const std::array<double, 3>& from, const std::array<double, 3>& along, double& begin, double& end) const;

  CubeGrid grid_;
  double per_mm_ = 0;  // cubes
  std::vector<Code> codes_;
};

inline ClearanceGrid::Place ClearanceGrid::at(const Point& p) const {
  Place found;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const double place = (p[axis] - grid_.origin[axis]) * per_mm_;
    if (!(place >= 0 && place < grid_.counts[i])) return found;
    found.cube[i] = static_cast<int>(place);
  }
  const Code code = codes_[grid_.index(found.cube)];
  found.state = code == 0 ? CubeState::near : code % 2 == 1 ? CubeState::outside : CubeState::inside;
  return found;
}

/// From block to block. Which cube is next follows from the wall that is met first, not from the rounded place, so that
/// each step gets on; what rounding does to the place is less than the slack of the cubes.
template <class Near>
void ClearanceGrid::walk(const Segment& segment, const Near& near) const {
  using Triple = std::array<double, 3>;
  const auto in_cubes = [&](const Vec& v) { return Triple{per_mm_ * v.x, per_mm_ * v.y, per_mm_ * v.z}; };
  const Triple from = in_cubes(segment.source - grid_.origin);
  const Triple along = in_cubes(segment.target - segment.source);
  double t = 0;
  double leave = 1;
  if (!clip(from, along, t, leave)) return;
  Triple slowness;
  std::array<int, 3> cube;
  std::array<std::size_t, 3> moving;  // the axes along which the segment gets on
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    slowness[i] = 1 / along[i];
    cube[i] = std::clamp(static_cast<int>(from[i] + t * along[i]), 0, grid_.counts[i] - 1);
    if (along[i] != 0) moving[count++] = i;
  }
  while (true) {
    const std::size_t index = grid_.index(cube);
    const int level = codes_[index] == 0 ? 0 : (codes_[index] - 1) / 2;
    std::array<int, 3> first;
    std::size_t across = 0;  // the axis of the wall that is met first
    double end = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = moving[k];
      first[i] = cube[i] >> level << level;
      const int wall = first[i] + (along[i] > 0 ? 1 << level : 0);
      const double met = (wall - from[i]) * slowness[i];
      if (met < end) across = i, end = met;
    }
    end = std::max(end, t);
    if (codes_[index] == 0) near(index, t, std::min(end, leave));
    if (end >= leave) return;
    if (level > 0) {
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t i = moving[k];
        const int last = std::min(first[i] + (1 << level), grid_.counts[i]) - 1;
        cube[i] = std::clamp(static_cast<int>(from[i] + end * along[i]), first[i], last);
      }
    }
    cube[across] = along[across] > 0 ? first[across] + (1 << level) : first[across] - 1;
    if (cube[across] < 0 || cube[across] >= grid_.counts[across]) return;
    t = end;
  }
}

}  // namespace scantet
