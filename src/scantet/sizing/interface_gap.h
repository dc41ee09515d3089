// How close the boundaries between different pairs of regions come to each other, as several levels of one scan do.
#pragma once

#include "scantet/base/progress.h"
#include "scantet/domain/domain.h"
#include "scantet/domain/sizing_field.h"

namespace scantet {

/// The gap at a point of the boundary is the distance to the nearest point that lies between another pair of regions.
struct InterfaceGaps {
  double share = 0;              ///< of the boundary that has a gap of less than alpha·σ; 0 … 1
  double least_mm = 0;           ///< the least gap in that share
  double median_mm = 0;          ///< the median gap in that share
  double expected_vertices = 0;  ///< of a mesh there, roughly: R1 refines until facets fit into the gap
};

/// Measures the gaps where lines 1/64 of the longest side of the bounds apart meet the boundary; a gap that is narrow
/// only between such places is passed over. size, alpha: as the mesher gets them. All 0 if the domain has one region
/// only, no gap is less than alpha·σ, or if cancelled. Error: a gap is up to 5 % too large; the vertices are right to a
/// factor of two. The same for any number of threads.
InterfaceGaps interface_gaps(const Domain& domain, const SizingField& size, double alpha, Progress& progress);

}  // namespace scantet
