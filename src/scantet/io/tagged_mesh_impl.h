// Meshes of files that number their nodes and elements as they like. Private to io/.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scantet/io/mesh_codecs_impl.h"

namespace scantet {

/// Nodes or elements under a name. Tags that the mesh has not are passed over.
struct TaggedSet {
  std::string name;
  std::vector<std::int64_t> tags;
};

/// A value each of some elements.
struct TaggedField {
  std::string name;
  std::vector<std::int64_t> tags;
  std::vector<double> values;
};

/// A triangle, which names its corners by tag.
struct TaggedTriangle {
  std::int64_t tag;
  std::array<std::uint64_t, 3> corners;
};

/// What stands in such a file: tets name their vertices by tag.
struct TaggedMesh {
  RawMesh mesh;
  std::vector<std::int64_t> node_tags;     ///< one a vertex
  std::vector<std::int64_t> element_tags;  ///< one a tet
  std::vector<TaggedTriangle> triangles;   ///< that may be in sets
  std::vector<TaggedSet> node_sets;
  std::vector<TaggedSet> element_sets;  ///< of tets and triangles
  std::vector<TaggedField> fields;      ///< of which those stay that have a value of every tet
};

/// Sorts vertices and tets (with their references) by tag, and turns the tags in the tets, in sets and in fields into
/// indices, in `mesh`.
/// Throws Error (input.bad_mesh): two nodes of one tag, a tet or a triangle of a set with a node that is not there.
void sort_by_tag(TaggedMesh& file, const std::string& path);

}  // namespace scantet
