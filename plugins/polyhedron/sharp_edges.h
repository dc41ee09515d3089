// The sharp edges of a surface as curves.
#pragma once

#include <array>
#include <memory>
#include <set>
#include <vector>

#include "scantet/domain/curve.h"
#include "surface.h"

namespace polyhedron {

struct SharpEdges {
  std::vector<std::shared_ptr<const scantet::Curve>> curves;  ///< between the inside and the outside
  std::vector<scantet::Corner> corners;                       ///< that the curves' ends refer to
};

/// Edges of a surface, and vertices that are corners whatever meets there.
struct MarkedEdges {
  std::vector<Surface::Edge_index> edges;  ///< ascending, without repeats
  std::set<std::array<double, 3>> corners{};
};

/// Chains of such edges. Corners are besides where three or more of them meet, where a chain ends, and where it turns
/// by `degrees` or more. Always in the same order.
SharpEdges chains_of(const Surface& surface, const MarkedEdges& marked, double degrees);

/// Chains of the edges at which the directions that two triangles face differ by `degrees` or more. Corners are where
/// three or more such edges meet, where a chain ends, and where it turns by `degrees` or more. surface: closed, of
/// triangles. degrees: > 0, up to 180. Always in the same order.
SharpEdges find_sharp_edges(const Surface& surface, double degrees);

}  // namespace polyhedron
