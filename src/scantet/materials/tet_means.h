// The mean of a function of a scan's values over each tet.
#pragma once

#include <functional>
#include <vector>

#include "scantet/base/tet_mesh.h"
#include "scantet/places/scan_values.h"

namespace scantet {

/// Of each tet the mean of of_value(voxel value), which is trilinear between voxel centres; beyond them it is what it
/// is at the nearest point of their box. Integrated in closed form: see scan_field(). On several threads, with the same
/// values for any number of them.
std::vector<double> tet_means(const TetMesh& mesh, const ScanValues& scan,
                              const std::function<double(double)>& of_value);

}  // namespace scantet
