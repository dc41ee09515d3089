// Private: whether the boundary of the mesh is a surface at its vertices.
#pragma once

#include <functional>
#include <vector>

#include "scantet/delaunay/triangulation_impl.h"

namespace scantet::engine {

/// The facets between two regions as seen from the one with the smaller number that is not outside, in the order of
/// their codes.
std::vector<FacetCode> boundary_facets(const Triangulation& t);

/// Finds out, for each vertex on ∂O that is not known to have a disk, whether the boundary facets around it form one
/// disk, and notes that. On a junction curve or at a corner it finds out whether the regions meet well there
/// (fault_of_star). facets: gives all of them; it is called only where many vertices are in question. Returns the
/// vertices without a disk, ascending; a vertex without facets has none.
std::vector<PointId> check_disks(Triangulation& t, const std::function<std::vector<FacetCode>()>& facets);

}  // namespace scantet::engine
