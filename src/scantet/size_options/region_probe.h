// Which regions there are, found by looking around points of the boundary.
#pragma once

#include <set>

#include "scantet/domain/domain.h"

namespace scantet {

/// How far apart points of the boundary are for a first look at the whole domain, mm: a share of its longest side.
double first_look_mm(const Domain& domain);

/// The regions but kOutside: of the domain's own list of components; if it has none, those around points of the
/// boundary.
std::set<Region> regions_of(const Domain& domain);

/// The region that p, a point of the boundary, counts to: the first found around p that is not kOutside, at a small
/// share of spacing_mm; kOutside if there is none.
Region region_beside(const Domain& domain, const Point& p, double spacing_mm);

}  // namespace scantet
