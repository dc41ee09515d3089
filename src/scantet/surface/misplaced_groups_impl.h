// Private: groups of tets on the wrong side of the boundary that give the mesh another topology.
#pragma once

#include <vector>

#include "scantet/delaunay/triangulation_impl.h"
#include "scantet/domain/domain.h"

namespace scantet::engine {

/// Tets of one region whose centroids are all in another one of the domain; one of both regions is kOutside.
struct MisplacedGroup {
  std::vector<CellId> cells;  ///< ascending
  Region to = kOutside;       ///< the region of the centroids
  int euler_change = 0;       ///< of the Euler number of all regions, as closed sets, where the group goes there; not 0
  Point place;                ///< a centroid, world mm
};

/// A tet is of the region that its circumcentre is in, and flat ones along the boundary have their centroids in another
/// often, which means nothing. So those that touch at facets form a group, and a group counts if the Euler number of
/// the inside would change with it, and that of the outside, too: where a ribbon has a hole, or a slit is bridged. (The
/// simple points of digital topology, for tets: Kong and Rosenfeld, *Digital topology: introduction and survey*, 1989.)
/// Tets with a vertex off the boundary are not looked at. Return: in the order of their first tets.
std::vector<MisplacedGroup> misplaced_groups(const Domain& domain, const Triangulation& t);

}  // namespace scantet::engine
