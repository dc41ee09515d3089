// How far the nodes of a grid are from a level set.
#pragma once

#include <array>
#include <vector>

#include "scantet/topology/sided_nodes.h"

namespace scantet {

/// About how far each node is from the level set, mm; at most limit_mm, and that in the padding. nodes: as they are
/// numbered there, none of them turned. spacing_mm: between nodes along each axis; angles of a sheared frame do not
/// count. Beside a node that has a neighbour on the other side along some axes the level set is taken for the plane
/// through where it crosses these edges: exact for planes. Elsewhere the nearest such place is looked for from
/// neighbour to neighbour, by Dijkstra's order. Costs grow with the nodes nearer than the limit.
std::vector<float> level_distances(const SidedNodes& nodes, const std::array<double, 3>& spacing_mm, double limit_mm);

}  // namespace scantet
