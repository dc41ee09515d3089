// Private to check/: how far a point is from a surface of a domain.
#pragma once

#include "scantet/domain/boundary_cells.h"

namespace scantet {

/// How far it is at the least and at the most, and the point of the surface that is so far.
struct NearestBoundary {
  double lower_mm = 0;
  double upper_mm = 0;  ///< infinite if nothing was found
  Point point;
};

/// The point of the surface nearest to p. around_mm: > 0, how far it may be; is enlarged until something is found, as
/// far as most_mm. enough_mm: as soon as a point so near is found, it is the answer, and the lower bound may be low.
/// tolerance: else the upper bound is at most so much more than the lower one, unless boxes are too small.
NearestBoundary nearest_boundary(const BoundaryCells& cells, std::size_t surface, const Point& p, double around_mm,
                                 double most_mm, double enough_mm, double tolerance);

}  // namespace scantet
