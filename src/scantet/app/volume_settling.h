// Boundary and mesh moved together, by a little, until regions have the volumes of the input.
#pragma once

#include "scantet/app/meshing.h"
#include "scantet/plugin/input_plugin.h"

namespace scantet {

/// What mesh_and_optimize() was given; either may be empty.
struct Searches {
  FaultSearch faults;
  LossSearch losses;  ///< asks opened.domain as it is then
};

/// Moves the boundary of what was opened (OpenedDomain::settle) and the vertices of the mesh that lie on it, away from
/// curves and corners, so that the volumes of the mesh's regions come nearer to those of the input; then improves the
/// mesh again where that broke a bound. Up to twice; where the mesh would lose anything by it, or volumes are no
/// nearer, both stay as they are. Does nothing if what was opened need not or cannot be settled, or if refinement did
/// not end by itself.
///
/// optimizer: as the mesh was improved by, with its rules; search: as of mesh_and_optimize(). Guarantee: what breaks
/// bounds, facets that cross, short edges, what the search finds and what is too far are no more than before.
void settle_volumes(const OptimizerOptions& optimizer, const SizingField& size, const Searches& searches,
                    OpenedDomain& opened, Progress& progress, Meshing& meshing);

}  // namespace scantet
