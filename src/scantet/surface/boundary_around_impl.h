// Private: points of the boundary that lie around a place.
#pragma once

#include <span>
#include <vector>

#include "scantet/domain/domain.h"

namespace scantet::engine {

struct BoundaryAround {
  std::vector<Point> points;  ///< of ∂O
  double apart_mm;            ///< so far from each other, and from the sample, they are worth inserting
};

/// The first points of ∂O in these directions from a place, those at most twice as far as the nearest. directions: not
/// 0, of any length. reach_mm: none is looked for farther away.
BoundaryAround boundary_around(const Domain& domain, const Point& place, std::span<const Vec> directions,
                               double reach_mm);

}  // namespace scantet::engine
