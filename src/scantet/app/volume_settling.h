// Boundary and mesh moved together, by a little, until regions have the volumes of the input.
#pragma once

#include <functional>
#include <optional>

#include "scantet/app/meshing.h"
#include "scantet/check/layers.h"
#include "scantet/plugin/input_plugin.h"

namespace scantet {

/// Counts layers across parts of a mesh; none if cancelled.
using LayerSearch = std::function<std::optional<LayerCheck>(const TetMesh&, const Progress&)>;

/// What mesh_and_optimize() was given, and what else the mesh must keep; each may be empty.
struct Searches {
  FaultSearch faults;
  LossSearch losses;  ///< asks opened.domain as it is then
  LayerSearch layers;
};

/// Moves the boundary of what was opened (OpenedDomain::settle) and the vertices of the mesh that lie on it, away from
/// curves and corners, so that the volumes of the mesh's regions come nearer to those of the input; then improves the
/// mesh again where that broke a bound. Up to three times; a move by which the mesh would lose anything is taken back,
/// and made again without what is around. Does nothing if what was opened need not or cannot be settled, or if
/// refinement did not end by itself. If cancelled, both are as far as the last move.
///
/// optimizer: as the mesh was improved by, with its rules; size: with its finer places. Guarantee: elements that break
/// bounds, facets that cross, short edges, and what the searches find, places with too few layers among it, and what is
/// too far are no more than before. With a search for layers, Meshing::layers is that of the mesh.
void settle_volumes(const OptimizerOptions& optimizer, const SizingField& size, const Searches& searches,
                    OpenedDomain& opened, Progress& progress, Meshing& meshing);

}  // namespace scantet
