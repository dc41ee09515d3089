// Volumes of a field's inside and of a mesh, between bounds.
#pragma once

#include <array>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/verify/voxel_nodes.h"

namespace scantet::verify {

/// Between which bounds the volume of {F inside} is, mm³.
std::array<double, 2> field_volume(const VoxelNodes& nodes, const Progress& progress);
/// The same of the tets, which are positive.
std::array<double, 2> mesh_volume(const TetMesh& mesh);
/// The same of what a closed surface bounds, whichever way it is turned: facets of these points.
std::array<double, 2> enclosed_volume(const std::vector<Point>& points, const std::vector<Triangle>& facets);

}  // namespace scantet::verify
