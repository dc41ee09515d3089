// Private: whether regions meet at a vertex as they can in a domain of balls, patches, junction curves and corners.
#pragma once

#include <span>
#include <vector>

#include "scantet/delaunay/triangulation_impl.h"

namespace scantet::engine {

/// What is wrong at a vertex of the boundary.
enum class StarFault : std::uint8_t {
  none,
  split_region,   ///< the tets of a region do not hang together through faces: a pinch
  ringed_region,  ///< those of a region hang together, but around another one
  split_patch,    ///< the facets between two regions do not hang together through edges: the regions meet twice
};

/// Looks at the cells around v, all of them: at a vertex where regions meet well the tets of each region form one ball,
/// so that what the vertex sees of it is a disk, and the facets between each two regions form one disk or one fan of
/// it; along a junction edge, and so around it, each pair of regions then follows each other once. With two regions
/// this is one disk of boundary facets, which check_disks() tells quicker. Reads only cells that have v.
StarFault fault_of_star(const Triangulation& t, PointId v, std::span<const CellId> star);

}  // namespace scantet::engine
