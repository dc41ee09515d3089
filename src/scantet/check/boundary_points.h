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

/// Whether the boundary's point p has the inside and the outside beside it: whether some line through it, of a tenth of
/// that length, crosses the boundary. Where the domain's height only touches the level none does: a part of the
/// boundary without width gets no facets, however many vertices are on it, and no mesh can show it.
bool has_width(const Domain& domain, const Point& p, double length_mm);

}  // namespace scantet
