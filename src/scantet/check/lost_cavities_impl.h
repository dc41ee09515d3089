// Private to check/: cavities of a grid of regions that a mesh has not.
#pragma once

#include "scantet/check/grid_nodes_impl.h"
#include "scantet/check/mesh_cavities_impl.h"

namespace scantet::auditing {

/// Records cavities none of whose nodes is outside the mesh, and those that are not cavities of their own. found: the
/// mesh's. outside: gets the nodes of kOutside, and which of these are kept. nodes: after find().
void find_lost_cavities(const MeshCavities& found, const GridNodes& nodes, const RegionGrid& grid, KeptRegion& outside,
                        AuditReport& report);

}  // namespace scantet::auditing
