// The last step of meshing: vertices go for the sake of short edges.
#pragma once

#include "scantet/app/meshing.h"

namespace scantet {

/// Takes vertices away where edges are shorter than optimizer.bounds.min_edge, as Meshing::conformance lists them, and
/// measures the mesh anew. Comes last, and once: no finer size makes edges longer. Facets may move by as much as they
/// typically are from the surface, and some were at the limit of the distance already: where more is beyond it than
/// before, facets come to cross, or more is lost, all is done anew without the vertices there, and if that does not
/// help, nothing. size: with its finer places. losses: that Meshing::lost came from; may be empty. meter: that measured
/// the mesh; null if none did. optimizer: with the rules (RuleTarget) that the mesh is to keep.
void lengthen_short_edges(const Domain& domain, const SizingField& size, const OptimizerOptions& optimizer,
                          const LossSearch& losses, DistanceMeter* meter, Progress& progress, Meshing& meshing);

}  // namespace scantet
