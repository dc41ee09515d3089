// What a mesh has lost of its domain, and smaller elements would keep.
#pragma once

#include <vector>

#include "scantet/base/tet_mesh.h"
#include "scantet/check/loss_count.h"
#include "scantet/domain/domain.h"
#include "scantet/domain/region_grid.h"
#include "scantet/domain/sizing_field.h"

namespace scantet {

/// Where the boundary of a mesh is not like that of a domain that was made from a grid of regions: a place, world mm,
/// for each gap in what follows a curve of the domain, each pinch, and each part, cavity or connection of the grid that
/// audit() would miss: of its findings audit.curve, audit.boundary_edge, audit.boundary_vertex, audit.joined_label,
/// audit.split_label, audit.broken_label, audit.cavity_missing and audit.cavity_joined those places that
/// Finding::places has. Of parts that are lost or shrunk, some nodes that they lack, a size apart. size: that the mesh
/// was asked for. Return: none of a mesh whose arrays are not whole.
RegionLosses find_losses(const TetMesh& mesh, const Domain& domain, const RegionGrid& grid, const SizingField& size);

/// Counts losses without a place, and lists gaps in curves. size: that the mesh was asked for. Return: none of a mesh
/// whose arrays are not whole.
LossCount count_losses(const TetMesh& mesh, const Domain& domain, const SizingField& size);

}  // namespace scantet
