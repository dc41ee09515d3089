// Circumcentres that depend on the points only, not on their order, and that stay right for flat tets.
#pragma once

#include <array>

#include "scantet/base/geometry.h"

namespace scantet::refine {

/// Circumcentre of four points in general position, mm. Any order of the points gives the same bits. Computed in double
/// precision; exactly (then rounded) where the points are so close to a plane that doubles would not do.
Point circumcenter(std::array<Point, 4> tet);

/// The same in double precision: NaN where that would not do, and last bits that depend on the order of the points
/// (none for sort_points). determinant: six times the volume, less some digits where the tet is flat.
Point quick_circumcenter(const std::array<Point, 4>& tet, double& determinant);

/// Lexicographic order.
void sort_points(std::array<Point, 4>& tet);

/// Circumradius over shortest edge of a triangle; infinity if it is degenerate.
double radius_edge(const Point& a, const Point& b, const Point& c);

/// Circumcentre of a triangle, mm.
Point circumcenter(const Point& a, const Point& b, const Point& c);

/// Squared length of the shortest of the six edges, mm².
double squared_shortest_edge(const std::array<Point, 4>& tet);

}  // namespace scantet::refine
