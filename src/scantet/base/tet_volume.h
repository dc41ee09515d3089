// The volume of a tet.
#pragma once

#include <array>
#include <cstddef>

#include "scantet/base/tet_mesh.h"

namespace scantet {

/// Signed, in the cube of the corners' unit: positive if the tet is positively oriented.
inline double tet_volume(const std::array<Point, 4>& corners) {
  return orientation_mm3(corners[0], corners[1], corners[2], corners[3]) / 6;
}

/// The same of a tet of a mesh, mm³.
inline double tet_volume_mm3(const TetMesh& mesh, std::size_t tet) {
  const Tet& t = mesh.tets[tet];
  return tet_volume({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]});
}

}  // namespace scantet
