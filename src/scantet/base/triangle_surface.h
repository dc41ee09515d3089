// A surface of triangles, with no geometry library in sight.
#pragma once

#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/tet_mesh.h"

namespace SCANTET_API scantet {

/// Facets between vertices; closed where it is the boundary of an object.
struct TriangleSurface {
  std::vector<Point> vertices;   ///< world, mm
  std::vector<Triangle> facets;  ///< of places in `vertices`, turned alike where two share an edge
};

}  // namespace scantet
