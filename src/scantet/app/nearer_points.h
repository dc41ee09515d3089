// Points that bring the boundary of a mesh nearer to that of its domain.
#pragma once

#include <vector>

#include "scantet/check/distance.h"
#include "scantet/refine/mesh_result.h"

namespace scantet {

/// Points of the domain's boundary to be vertices of a mesh that is farther than distance.limit_mm from it: where the
/// two are too far apart, the farthest first; where vertices do not make facets, close together. distance: of that
/// mesh, with a limit. round: from 0 on, how often that has been done already; points come closer together. There are a
/// quarter as many as the mesh has vertices at the most.
std::vector<Point> nearer_points(const Domain& domain, const BoundaryDistance& distance, const MeshResult& mesh,
                                 int round);

/// Points of the domain's boundary around places of it, one in each box of `share` of a cell that holds one: close
/// together, but neither as close to each other as a quarter of such a box, nor to a vertex. share: 1, 1/2, 1/4, …
std::vector<Point> close_points(const Domain& domain, const std::vector<Point>& places, double share,
                                const std::vector<Point>& vertices);

}  // namespace scantet
