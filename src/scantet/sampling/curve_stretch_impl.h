// Balls that cover a stretch of a curve.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace scantet {

/// How large a ball may be at a place on a curve.
struct CurveRoom {
  double along_mm;
  double radius_mm;
};

/// A part of a curve. At its end, unless that is a corner, what comes next has a ball.
struct CurveStretch {
  double from_mm;  ///< along the curve
  double to_mm;
  bool after_corner = false;   ///< where it begins, the ball of a corner ends
  bool before_corner = false;  ///< where it ends, that of another one begins
  std::size_t fewest = 1;      ///< balls
};

struct CurveBall {
  double along_mm;
  double radius_mm;
};

/// Balls no larger than the rooms, of which there are at least two, ascending, with the stretch between the first and
/// the last; radii in between are linear. In order; neighbours are 1.5 radii apart. The first is where the stretch
/// begins, or half a radius from there after a corner.
std::vector<CurveBall> cover_stretch(std::span<const CurveRoom> rooms, const CurveStretch& stretch);

}  // namespace scantet
