// Numbers and names for the regions and boundaries of a mesh, the same in every format that has tags. Private to io/.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scantet/base/tet_mesh.h"

namespace scantet {

/// A region of the mesh as a group of tets.
struct VolumeTag {
  Region region;
  int tag;           ///< the region itself if all regions are positive, else counted from 1
  std::string name;  ///< "region_3", or the mesh's own, made plain and distinct
  bool is_named;     ///< the mesh has a name of its own for it
};

/// The facets between two regions as a group.
struct SurfaceTag {
  std::array<Region, 2> regions;  ///< {behind, in front}
  int tag;                        ///< above all volume tags, so that no number means two things
  std::string name;               ///< "boundary_3_0", or the mesh's own, made plain and distinct
  bool is_named;                  ///< the mesh has a name of its own for it
};

/// The groups of one mesh, and for each tet and facet the index of its group. Groups are sorted by region.
struct MeshTags {
  std::vector<VolumeTag> volumes;
  std::vector<SurfaceTag> surfaces;
  std::vector<std::uint32_t> volume_of_tet;
  std::vector<std::uint32_t> surface_of_facet;
  std::vector<std::size_t> tets_in;    ///< one a volume: how many tets
  std::vector<std::size_t> facets_in;  ///< one a surface: how many facets
};

MeshTags make_tags(const TetMesh& mesh);

/// Indices 0 … group_of.size() - 1 ordered by group, ascending inside a group.
std::vector<std::uint32_t> order_by_group(const std::vector<std::uint32_t>& group_of,
                                          const std::vector<std::size_t>& size_of);

}  // namespace scantet
