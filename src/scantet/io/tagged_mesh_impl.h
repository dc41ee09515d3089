// Meshes of files that number their nodes and elements as they like. Private to io/.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scantet/io/mesh_codecs_impl.h"

namespace scantet {

/// What stands in such a file: tets name their vertices by tag.
struct TaggedMesh {
  RawMesh mesh;
  std::vector<std::int64_t> node_tags;     ///< one a vertex
  std::vector<std::int64_t> element_tags;  ///< one a tet
};

/// Sorts vertices and tets (with their references) by tag, and turns the tags in the tets into indices.
/// Throws Error (input.bad_mesh): two nodes of one tag, a tet with a node that is not there.
void sort_by_tag(TaggedMesh& file, const std::string& path);

}  // namespace scantet
