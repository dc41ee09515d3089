// Private: whether regions meet at a vertex as they can in a domain of balls, patches, junction curves and corners.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "scantet/delaunay/triangulation_impl.h"

namespace scantet::engine {

/// Of a boundary facet at a vertex, the edge across from it.
using LinkEdge = std::array<PointId, 2>;

/// Whether the edges form one closed path through each of their vertices. Reorders them.
bool is_one_cycle(std::span<LinkEdge> edges);

/// Whether regions meet well at v. star: the cells around it, all of them. There the tets of each region form one ball,
/// so that what the vertex sees of it is a disk, and the facets between each two regions form one disk or one fan of
/// it; along a junction edge, and so around it, each pair of regions then follows each other once. With two regions
/// this is one disk of boundary facets, which check_disks() tells quicker. Reads only cells that have v.
bool regions_meet_well(const Triangulation& t, PointId v, std::span<const CellId> star);

}  // namespace scantet::engine
