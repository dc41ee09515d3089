// Sets and surfaces of Abaqus input, once all of the file has been read. Private to io/.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scantet/io/tagged_mesh_impl.h"

namespace scantet {

/// A surface: elements with the number of a face of each, 1 … 4.
struct InpSurface {
  std::string name;
  std::vector<std::pair<std::int64_t, int>> faces;
};

/// Takes away the sets of a file of ours that tets and regions imply, and what stands before the names of others.
/// is_region: whether elements are in a region of the name.
void drop_derived_sets(const std::function<bool(std::string_view)>& is_region, TaggedMesh& file,
                       std::vector<InpSurface>& surfaces);

/// Takes away the set NALL if it has all nodes, whoever wrote the file.
void drop_set_of_all_nodes(TaggedMesh& file);

/// Puts surfaces among the sets of facets. Pre: tets are sorted by tag.
void resolve_surfaces(const std::vector<InpSurface>& surfaces, TaggedMesh& file);

}  // namespace scantet
