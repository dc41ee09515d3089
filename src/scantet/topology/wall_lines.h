// Lines in a face at the level along which parts on either side of it touch.
#pragma once

#include <array>

namespace scantet {

/// Beside a face at the level, on one side of it, the field is a bilinear function times the distance from it. Its
/// values above the corners of the face, in their order around it.
using WallHeights = std::array<double, 4>;

/// The part of {beside > 0} that a corner lies in, on one side of the face.
struct WallPart {
  WallHeights beside;
  int corner;    ///< beside[corner] > 0
  bool is_high;  ///< on which side
};

/// Along how many stretches of lines in the open face {a > 0} on its one side and {b > 0} on the other touch, with
/// nothing of either on both sides. Guarantee: exact wherever the products of two values are.
int touching_lines(const WallHeights& a, const WallHeights& b);

/// Eight times what such lines add to the Euler number of {a > 0} and {b > 0}, which they join, and what lines at the
/// level that lead from the face into the cells beside it add there: each ends twice, and half of it counts at each
/// end.
int wall_line_shares(const std::array<WallHeights, 2>& beside);

}  // namespace scantet
