// What of the scan the mesh lacks on purpose: components that were left out, cavities that were filled. A part changes
// its side by that, and the level set without the surfaces between parts of one side is what the mesh must be.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/verify/boundary_rays.h"
#include "scantet/verify/field_parts.h"

namespace scantet::verify {

/// On which side nodes are, parts that were left out on the side of what is around them.
class NodeSides {
 public:
  NodeSides() = default;
  NodeSides(const VoxelNodes& nodes, const FieldParts& parts, const std::vector<std::uint8_t>& is_left_out);
  bool any() const { return !side_.empty(); }
  bool is_left_out(const Cell& at) const { return any() && (side_[node(at, 0)] & kLeftOut) != 0; }
  /// Whether a corner of the cell is in a part that was left out.
  bool has_left_out(const Cell& cell) const;
  /// The side of all corners: 1 or -1; 0 if they are not all of one side.
  int side_of(const Cell& cell) const;

 private:
  static constexpr std::int8_t kInside = 1;
  static constexpr std::int8_t kOutside = 2;
  static constexpr std::int8_t kLeftOut = 4;
  std::size_t node(const Cell& cell, int corner) const;
  Cell width_{};
  std::vector<std::int8_t> side_;  // bits; none if nothing was left out
};

/// The parts of a field without those that were left out.
struct LeftOut {
  std::vector<std::uint8_t> is_left_out;    ///< one a part
  std::vector<LeftOutPart> list;            ///< the largest first
  std::vector<Point> places;                ///< a node of each, and others, that no collar may hold
  FieldParts rest;                          ///< what is left; its part_of is empty
  std::vector<std::uint32_t> part_in_rest;  ///< one a part
  NodeSides sides;
  bool is_sound = true;  ///< each part of what is left has its node of greatest height on its side of the mesh
};

/// Which of the parts that may be left out the mesh lacks: components whose deepest node it does not cover, cavities
/// whose deepest node it covers. rays: of a closed boundary.
LeftOut find_left_out(const BoundaryRays& rays, const VoxelNodes& nodes, const FieldParts& parts,
                      const MayBeLeftOut& allowed);

}  // namespace scantet::verify
