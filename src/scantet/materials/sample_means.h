// The mean of a function of a scan's values over samples of each tet: the voxels in it, or its corners.
#pragma once

#include <functional>
#include <vector>

#include "scantet/base/tet_mesh.h"
#include "scantet/places/scan_values.h"

namespace scantet {

/// Of each tet the mean of of_value(voxel value) of the voxels whose centres are in it, its faces included; of a tet
/// without any, that of the eight voxels around its centroid. On several threads, with the same values for any number
/// of them. Source: Zannoni, Mantovani, Viceconti 1998; for small tets py_bonemat_abaqus.
std::vector<double> voxel_means(const TetMesh& mesh, const ScanValues& scan,
                                const std::function<double(double)>& of_value);

/// Of each tet the mean of of_value(value) at its four corners, where values are trilinear between voxel centres.
std::vector<double> corner_means(const TetMesh& mesh, const ScanValues& scan,
                                 const std::function<double(double)>& of_value);

}  // namespace scantet
