// Parts of a domain that a mesh has nothing of, though its components and handles are right: thin sheets and spikes.
#pragma once

#include <vector>

#include "scantet/check/distance.h"
#include "scantet/domain/domain.h"
#include "scantet/domain/sizing_field.h"

namespace scantet {

/// Points of the domain's boundary that are farther than kFarInSizes times the size from the mesh's
/// (OneWayDistance::far); of a domain without boundary_cells(), none. Distances are measured only if some cell has no
/// vertex of the mesh's boundary near it. domain, size: asked from several threads at once.
std::vector<FarPlace> find_lost_parts(const TetMesh& mesh, const Domain& domain, const SizingField& size);

/// Points of the domain's boundary around such parts, as far as these reach, to be vertices: one in each box of `share`
/// of a cell that has one, and none of them near a point of `sample`. share: 1, 1/2, 1/4, …
std::vector<Point> points_on_parts(const Domain& domain, const std::vector<FarPlace>& parts,
                                   const std::vector<Point>& sample, double share);

}  // namespace scantet
