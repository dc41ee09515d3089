// Private: from the triangulation to plain arrays.
#pragma once

#include "scantet/base/tet_mesh.h"
#include "scantet/surface/restricted_triangulation_impl.h"

namespace scantet::engine {

/// Pieces of sharp curves between neighbours.
struct SharpEdge {
  std::array<PointId, 2> vertices;
  std::uint32_t curve;  ///< of `curves`
};
struct SharpEdges {
  std::vector<MeshCurve> curves;
  std::vector<SharpEdge> edges;  ///< those that are no edges of the boundary are left out
};

/// The mesh: the cells whose circumcentre is inside, in their order; their vertices, along a space-filling curve; and
/// their boundary, in the order of its vertices.
TetMesh extract_mesh(const RestrictedTriangulation& triangulation, const SharpEdges& sharp = {});

}  // namespace scantet::engine
