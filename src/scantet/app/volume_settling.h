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
/// mesh again where that broke a bound. Up to three times; a move by which the mesh would lose anything is taken back,
/// and made again without what is around. Does nothing if what was opened need not or cannot be settled, or if
/// refinement did not end by itself. If cancelled, both are as far as the last move.
///
/// optimizer: as the mesh was improved by, with its rules; size: with its finer places. Guarantee: elements that break
/// bounds, facets that cross, short edges, and what the searches find and what is too far are no more than before.
void settle_volumes(const OptimizerOptions& optimizer, const SizingField& size, const Searches& searches,
                    OpenedDomain& opened, Progress& progress, Meshing& meshing);

}  // namespace scantet
