// The mean of a function of a scan's values over each tet.
#pragma once

#include <functional>
#include <vector>

#include "scantet/base/tet_mesh.h"
#include "scantet/places/scan_values.h"

namespace scantet {

/// Of each tet the mean of of_value(voxel value), which is trilinear between voxel centres; beyond them it is what it
/// is at the nearest point of their box. By a rule of order 2 in each of 64 parts of the tet, which is exact where the
/// field is one polynomial of degree 2; across the borders of voxels its error falls with the parts' size. On several
/// threads, with the same values for any number of them.
std::vector<double> tet_means(const TetMesh& mesh, const ScanValues& scan,
                              const std::function<double(double)>& of_value);

}  // namespace scantet
