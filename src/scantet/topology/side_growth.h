// One side of a level set, grown anew from its thick parts without making handles.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/base/union_find.h"
#include "scantet/topology/sided_nodes.h"

namespace scantet {

/// Unites the nodes of one side that edges, faces and bodies of cells join. sets: one label a node.
void unite_side(const SidedNodes& nodes, bool inside, UnionFind& sets);

/// The side that grows.
struct Growth {
  UnionFind sets;                                  ///< of its nodes, those that are joined, without the groups
  std::vector<std::vector<std::uint32_t>> groups;  ///< its other nodes; those that touch are in one, each ascending
};

/// Takes from one side the nodes nearer to the level set than core_mm, and gives them back one by one, the farthest
/// first, wherever that makes no handle: joins of parts that are not joined yet, and walls between parts of the other
/// side, are made again. What is never given back is in groups: without these there are as few handles as so thick a
/// side can have.
///
/// nodes: are left as they were. Those that are turned stay on their side. distances: as of level_distances(), before
/// any was turned. component_of: of each node, a number; each component of the side keeps at least one node that has
/// not been turned, or one of the padding. Of no use once progress.cancelled() became true.
Growth grow_side(SidedNodes& nodes, bool inside, double core_mm, const std::vector<float>& distances,
                 const std::vector<std::uint32_t>& component_of, const Progress& progress);

}  // namespace scantet
