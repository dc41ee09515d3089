// The entities of a Gmsh file: groups of elements, cut where sets of elements begin and end. Private to io/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scantet/io/mesh_tags_impl.h"

namespace scantet {

/// Groups in parts, each of elements of the same sets: Gmsh's entities do not overlap, but may have several physical
/// groups.
struct GroupParts {
  struct Part {
    std::uint32_t group;
    std::vector<std::uint32_t> sets;
    std::size_t count;  ///< of elements; may be 0
  };
  std::vector<Part> parts;             ///< the first ones are what no set has, one a group
  std::vector<std::uint32_t> part_of;  ///< of each element

  /// How many parts have elements.
  std::size_t used() const;
  /// The elements ordered by part, ascending inside a part.
  std::vector<std::uint32_t> order() const;
};

/// The parts of `groups` groups. group_of: of each element. members: of a set, those elements.
GroupParts with_sets(const std::vector<NamedSet>& sets, std::vector<std::uint32_t> MeshSet::*members,
                     const std::vector<std::uint32_t>& group_of, std::size_t groups);

/// The parts where there are no sets: one a group.
GroupParts without_sets(const std::vector<std::uint32_t>& group_of, std::size_t groups);

}  // namespace scantet
