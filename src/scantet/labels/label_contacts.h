// Which regions of a segmentation lie beside each other.
#pragma once

#include <map>
#include <set>

#include "scantet/domain/region_grid.h"

namespace scantet {

/// Of each region that nodes of the grid have, kOutside included, the others that it has neighbours of along an axis.
std::map<Region, std::set<Region>> regions_in_contact(const RegionGrid& grid);

}  // namespace scantet
