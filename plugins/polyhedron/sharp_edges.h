// The sharp edges of a surface as curves.
#pragma once

#include <memory>
#include <vector>

#include "scantet/domain/curve.h"
#include "surface.h"

namespace polyhedron {

struct SharpEdges {
  std::vector<std::shared_ptr<const scantet::Curve>> curves;  ///< between the inside and the outside
  std::vector<scantet::Corner> corners;                       ///< that the curves' ends refer to
};

/// Chains of the edges at which the directions that two triangles face differ by `degrees` or more. Corners are where
/// three or more such edges meet, where a chain ends, and where it turns by `degrees` or more. surface: closed, of
/// triangles. degrees: > 0, up to 180. Always in the same order.
SharpEdges find_sharp_edges(const Surface& surface, double degrees);

}  // namespace polyhedron
