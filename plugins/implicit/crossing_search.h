// Where a formula changes its sign along a segment.
#pragma once

#include "formula_grid.h"
#include "scantet/domain/domain.h"

namespace implicit {

/// Overwrites `out` with the places where the sign of the formula changes on the segment, in order from its source;
/// inside (region 1) is where it is negative.
/// Guarantees: every change of sign is found but pairs that lie within 1e-12 of the segment's length of each other (on
/// a segment that touches the surface over and over, or to high order: 1e-9, 1e-6 or 1e-3, the first that takes no more
/// than 20,000 pieces). The regions follow on each other and fit the sign at both ends.
/// grid: of the formula, over a box that holds the segment.
void find_crossings(const Formula& formula, const FormulaGrid& grid, const scantet::Segment& segment,
                    scantet::Crossings& out);

}  // namespace implicit
