// How far the boundary of a mesh and the surface of a polyhedron are from each other.
#pragma once

#include "scantet/base/tet_mesh.h"
#include "scantet/domain/domain.h"

namespace scantet::bench {

struct SurfaceGap {
  double from_mesh_mm = 0;     ///< farthest sample of the mesh's boundary facets (15 on each) from the surface
  double from_surface_mm = 0;  ///< farthest sample of the surface from those facets
};

/// polyhedron: what the plugin of that name opens, whose residual_at is a distance. spacing_mm: of the samples on it.
SurfaceGap surface_gap(const TetMesh& mesh, const Domain& polyhedron, double spacing_mm);

}  // namespace scantet::bench
