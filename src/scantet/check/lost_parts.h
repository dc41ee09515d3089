// Parts of a domain that a mesh has nothing of, though its components and handles are right: thin sheets and spikes.
#pragma once

#include <vector>

#include "scantet/check/distance.h"

namespace scantet {

/// Points of the domain's boundary that are farther than kFarInSizes times the size from the mesh's and have width
/// (has_width()), those left out that are near a farther one, as in OneWayDistance::far. They are looked for in its
/// cells (Domain::boundary_cells()), one in each; of a domain without cells among points as far apart as facets are
/// wide. domain, size: asked from several threads at once.
std::vector<FarPlace> find_lost_parts(const TetMesh& mesh, const Domain& domain, const SizingField& size);

}  // namespace scantet
