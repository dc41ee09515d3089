// Where two bilinear functions on a square are positive together.
#pragma once

#include <array>

#include "scantet/topology/wall_lines.h"

namespace scantet {

/// The Euler number of the closure of {a > 0} ∩ {b > 0} within the open square, pieces of it that touch at a point
/// counted apart there; open ends count as for the Euler number with compact support, so that of the whole open square
/// is 1. a, b: at the corners (0,0), (1,0), (1,1), (0,1). Guarantee: exact where sums of products of four values are,
/// unless both are zero along a common curve.
int euler_of_overlap(const std::array<double, 4>& a, const std::array<double, 4>& b);

/// Whether two parts on opposite sides of a face overlap in it. Guarantee: as of euler_of_overlap().
bool do_overlap(const WallPart& a, const WallPart& b);

}  // namespace scantet
