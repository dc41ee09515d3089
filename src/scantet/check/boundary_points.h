// Points of a domain's boundary near places of it.
#pragma once

#include <span>
#include <vector>

#include "scantet/domain/domain.h"

namespace scantet {

/// Points of the boundary in the cells (Domain::boundary_cells()) that hold the places, which are points of it: one in
/// each box of `share` of a cell that has one. In the order of the places, a cell once. Of a domain without cells:
/// none. share: 1, 1/2, 1/4, …
std::vector<Point> boundary_points_near(const Domain& domain, std::span<const Point> places, double share);

/// The same in the cells that meet the boxes, world mm; a point may lie beyond them by as much as a cell.
std::vector<Point> boundary_points_in(const Domain& domain, std::span<const Box> boxes, double share);

}  // namespace scantet
