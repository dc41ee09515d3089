// Whether a mesh can be measured at all. Private to quality/.
#pragma once

#include "scantet/base/tet_mesh.h"

namespace scantet {

/// Throws Error (mesh.inconsistent): a vertex that does not exist, a coordinate beyond kLargestCoordinateMm, or not a
/// region for each tet. Names the first. Several threads.
void check_measurable(const TetMesh& mesh);

}  // namespace scantet
