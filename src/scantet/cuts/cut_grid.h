// What planes leave of a grid of regions.
#pragma once

#include <vector>

#include "scantet/cuts/cut_plane.h"
#include "scantet/domain/region_grid.h"

namespace scantet {

/// The grid of what make_cut_domain() leaves: nodes on a plane or beyond are in kOutside, but for those of the border's
/// planes, which go through the outermost nodes and take none. Parts are as the whole grid has them, without those
/// nodes; one of which none are left is gone, as is such a region. The volume of a region is not known (NaN) if a plane
/// comes so near to one of its nodes that it may cut the region.
RegionGrid cut_grid(const RegionGrid& grid, const std::vector<CutPlane>& planes);

}  // namespace scantet
