// Volumes of regions, in a mesh and in a label map, between bounds.
#pragma once

#include <array>
#include <map>

#include "scantet/base/progress.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/verify/label_source.h"

namespace scantet::verify {

/// Between which bounds the volume of each region is, mm³; of kOutside not told.
std::map<Region, std::array<double, 2>> region_volumes(const LabelSource& labels, const Progress& progress);
/// The same of the tets, which are positive.
std::map<Region, std::array<double, 2>> region_volumes(const TetMesh& mesh);

}  // namespace scantet::verify
