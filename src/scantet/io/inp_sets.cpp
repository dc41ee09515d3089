// What a set is follows from its name alone. Faces are counted as Abaqus counts them, by the corners that they hold.
#include <algorithm>

#include "scantet/io/inp_sets_impl.h"
#include "scantet/io/mesh_tags_impl.h"

namespace scantet {

void drop_derived_sets(const std::function<bool(std::string_view)>& is_region, TaggedMesh& file,
                       std::vector<InpSurface>& surfaces) {
  std::erase_if(file.node_sets, [&](const TaggedSet& set) {
    constexpr std::string_view kNodesOf = "NODES_";
    const std::string_view name = set.name;
    const bool is_of_region = name.starts_with(kNodesOf) && is_region(name.substr(kNodesOf.size()));
    return is_of_region || name == "BOUNDARY" || is_curve_name(name);
  });
  std::erase_if(surfaces, [](const InpSurface& surface) { return is_boundary_name(surface.name); });
  constexpr std::string_view kElementsOf = "ELEMENTS_";
  for (TaggedSet& set : file.element_sets) {
    if (set.name.starts_with(kElementsOf)) set.name.erase(0, kElementsOf.size());
  }
}

void drop_set_of_all_nodes(TaggedMesh& file) {
  const auto is_it = [](const TaggedSet& set) { return set.name == "NALL"; };
  std::size_t nodes = 0;
  for (const TaggedSet& set : file.node_sets) nodes += is_it(set) ? set.tags.size() : 0;
  if (nodes == file.node_tags.size()) std::erase_if(file.node_sets, is_it);
}

void resolve_surfaces(const std::vector<InpSurface>& surfaces, TaggedMesh& file) {
  const std::vector<std::int64_t>& tags = file.element_tags;
  constexpr std::size_t kCorners[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  for (const InpSurface& surface : surfaces) {
    NamedTriangles& found = file.mesh.facet_sets.emplace_back(NamedTriangles{surface.name, {}});
    for (const auto& [element, face] : surface.faces) {
      const auto tag = std::lower_bound(tags.begin(), tags.end(), element);
      if (tag == tags.end() || *tag != element) continue;
      const auto& tet = file.mesh.tets[static_cast<std::size_t>(tag - tags.begin())];
      const auto& corners = kCorners[face - 1];
      found.corners.push_back({tet[corners[0]], tet[corners[1]], tet[corners[2]]});
    }
  }
}

}  // namespace scantet
