// Which vertices a mesh has on its boundary, by its own word.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/base/tet_mesh.h"

namespace scantet::test {

/// One a vertex: 1 if it is on the boundary.
inline std::vector<std::uint8_t> boundary_flags(const TetMesh& mesh) {
  std::vector<std::uint8_t> flags;
  for (VertexId v = 0; v < mesh.strata.size(); ++v) flags.push_back(mesh.on_boundary(v) ? 1 : 0);
  return flags;
}

}  // namespace scantet::test
