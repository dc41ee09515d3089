// What the level set of a scan consists of, counted exactly: the parts inside and outside, and their Euler numbers.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/verify/voxel_nodes.h"

namespace scantet::verify {

/// A connected part of one side of the level.
struct FieldPart {
  int side = 1;                    ///< 1 inside, -1 outside
  std::int64_t nodes = 0;          ///< in the image, the layer around it left out
  std::int64_t euler = 0;          ///< of the part; its boundary has twice that. Not counted of the unbounded part
  Cell deepest{};                  ///< the node farthest from the level
  bool is_unbounded = false;       ///< it reaches the layer around the image
  std::uint32_t around = kNoPart;  ///< the part around it, of a smaller number; kNoPart: it is unbounded, or not known
  static constexpr std::uint32_t kNoPart = 0xffffffff;
};

struct FieldParts {
  std::vector<FieldPart> parts;
  std::vector<std::uint32_t>
      part_of;  ///< of nodes, the layer around the image included, x fastest; kNoPart at the level
  std::int64_t inside = 0;
  std::int64_t outside = 0;  ///< the unbounded part included
  std::int64_t nodes_at_level = 0;
  /// Nodes at the level that have not a node inside and one outside beside them along the axes; and one of them.
  std::int64_t loose_nodes = 0;
  Cell loose_node{};
  bool is_known = true;           ///< false: ties in cells that are not resolved
  bool has_tied_saddles = false;  ///< saddles of faces or cells are at the level, so that other parts may touch there
};

/// Ties: nodes and saddles at the level belong to neither side, so parts that only touch there are apart. Takes nine
/// bytes a node. Throws Error: input.too_large (2^32 nodes or more).
FieldParts field_parts(const VoxelNodes& nodes, const Progress& progress);

}  // namespace scantet::verify
