// Private to check/: which edges of a grid of regions lie in tets of their region, where the boundary does not cross
// them.
#pragma once

#include <array>
#include <vector>

#include "scantet/base/frame.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/check/cell_collapse_impl.h"
#include "scantet/domain/region_grid.h"

namespace scantet::auditing {

/// Whether a tet, with its faces, holds a place.
bool is_in_tet(const std::array<Vec, 4>& corners, const Vec& place);

/// edges: that the boundary does not cross between their ends, so that their middles tell. regions: theirs, one each.
/// Return: the edges none of whose surroundings is in a tet of the region; of kOutside, those all around which is in
/// tets. In their order.
std::vector<GridCell> edges_not_held(const TetMesh& mesh, const Frame& frame, const std::vector<GridCell>& edges,
                                     const std::vector<Region>& regions);

}  // namespace scantet::auditing
