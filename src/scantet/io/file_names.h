// What files call regions, sets and materials, for other files that refer to them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scantet/base/tet_mesh.h"

namespace scantet {

struct TagNames {
  std::map<Region, std::string> regions;  ///< of each region of the mesh
  std::vector<std::string> sets;          ///< one a set of the mesh
};

/// Of most files: letters, digits and _ - . after a letter, and no two that differ by capitals alone.
TagNames tag_names(const TetMesh& mesh);

struct InpNames {
  std::map<Region, std::string> regions;  ///< of each region of the mesh, as a set of its elements
  std::vector<std::string> sets;          ///< one a set of the mesh: of its nodes, and of its facets as a surface
  std::vector<std::string> materials;     ///< one a material: of its elements, and of itself
};

/// Of .inp files: letters in capitals, digits and underscores only.
InpNames inp_names(const TetMesh& mesh);

/// Of .xdmf files and the arrays beside them: one a set of the mesh.
std::vector<std::string> xdmf_set_names(const TetMesh& mesh);

}  // namespace scantet
