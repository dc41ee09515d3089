// Points that bring the boundary of a mesh nearer to that of its domain.
#pragma once

#include <span>
#include <vector>

#include "scantet/check/distance.h"
#include "scantet/refine/mesh_result.h"

namespace scantet {

/// Points of the domain's boundary where it and a mesh's are farther from each other than distance.limit_mm, the
/// farthest first. Where nothing was measured none is known.
std::vector<Point> far_points(const BoundaryDistance& distance);

/// Of these, as far_points() gives them for a mesh that is to be within limit_mm, the points to be vertices of it, the
/// farthest first, a quarter as many as it has vertices at the most. round: from 0 on, how often that has been done
/// already; points come closer together.
std::vector<Point> nearer_points(std::span<const Point> far, double limit_mm, const MeshResult& mesh, int round);

/// Points of the domain's boundary around parts of it that a mesh has nothing of (find_lost_parts()), as far as these
/// are from the mesh: one in each box of `share` of a cell that has one, but none nearer to another one, or to a
/// vertex, than a quarter of a box. Of a domain without cells (Domain::boundary_cells()) as much as a quarter of the
/// least distance of a part stands for a cell's edge. vertices: of that mesh. share: 1, 1/2, 1/4, …
std::vector<Point> points_on_parts(const Domain& domain, const std::vector<FarPlace>& parts,
                                   const std::vector<Point>& vertices, double share);

}  // namespace scantet
