// Private: which edges are too short.
#pragma once

#include <vector>

#include "scantet/base/tet_mesh.h"
#include "scantet/optimize/element_bounds.h"

namespace scantet::optimize {

struct ShortEdge {
  double share;                    ///< its length over the least that will do, under 1
  std::array<VertexId, 2> vertex;  ///< ascending

  friend bool operator<(const ShortEdge& a, const ShortEdge& b) {
    return a.share != b.share ? a.share < b.share : a.vertex < b.vertex;
  }
};

/// Lists the edges that are shorter than the target, each once, the worst first. On several threads.
std::vector<ShortEdge> short_edges(const TetMesh& mesh, const EdgeTarget& target);

}  // namespace scantet::optimize
