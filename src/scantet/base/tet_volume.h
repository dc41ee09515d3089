// The volume of a tet of a mesh.
#pragma once

#include <cstddef>

#include "scantet/base/tet_mesh.h"

namespace scantet {

/// Signed, mm³: positive if the tet is positively oriented.
inline double tet_volume_mm3(const TetMesh& mesh, std::size_t tet) {
  const Tet& t = mesh.tets[tet];
  return orientation_mm3(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]) / 6;
}

}  // namespace scantet
