// What files call sets and materials, for other files that refer to them.
#pragma once

#include <string>
#include <vector>

#include "scantet/base/tet_mesh.h"

namespace scantet {

struct InpNames {
  std::vector<std::string> sets;       ///< one a set of the mesh: of its nodes, and of its facets as a surface
  std::vector<std::string> materials;  ///< one a material: of its elements, and of itself
};

/// Of .inp files: letters in capitals, digits and underscores only.
InpNames inp_names(const TetMesh& mesh);

/// Of .xdmf files and the arrays beside them: one a set of the mesh.
std::vector<std::string> xdmf_set_names(const TetMesh& mesh);

}  // namespace scantet
