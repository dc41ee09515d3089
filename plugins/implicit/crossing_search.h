// Where a formula changes its sign along a segment.
#pragma once

#include "formula.h"
#include "scantet/domain/clearance_grid.h"
#include "scantet/domain/domain.h"

namespace implicit {

/// What is known of where the formula keeps its sign: where a cube is clear, it is negative (inside) or not (outside)
/// in all of it, on doubles.
scantet::ClearanceGrid clearance_of(const Formula& formula, const scantet::Box& box);

/// Overwrites `out` with the places where the sign of the formula changes on the segment, in order from its source;
/// inside (region 1) is where it is negative.
/// Guarantees: every change of sign is found but pairs that lie within 1e-12 of the segment's length of each other (on
/// a segment that touches the surface over and over, or to high order: 1e-9, 1e-6 or 1e-3, the first that takes no more
/// than 20,000 pieces). The regions follow on each other and fit the sign at both ends.
/// clear: of the formula, over a box that holds the segment.
void find_crossings(const Formula& formula, const scantet::ClearanceGrid& clear, const scantet::Segment& segment,
                    scantet::Crossings& out);

}  // namespace implicit
