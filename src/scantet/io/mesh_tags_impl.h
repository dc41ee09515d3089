// Numbers and names for the regions and boundaries of a mesh, the same in every format that has tags. Private to io/.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
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

/// The edges of a curve as a group.
struct CurveTag {
  std::vector<Region> regions;  ///< around it, ascending
  int tag;                      ///< above all surface tags
  std::string name;             ///< "curve_0_1_2" of these regions, or the mesh's own, made plain and distinct
  bool is_named;                ///< the mesh has a name of its own for it
  bool is_sharp;                ///< MeshCurve::is_sharp
};

/// All corners of curves as a group.
struct CornerTag {
  int tag;           ///< above all curve tags
  std::string name;  ///< "corners", made distinct
};

/// The groups of one mesh, and for each tet and facet the index of its group. Groups are sorted by region.
struct MeshTags {
  std::vector<VolumeTag> volumes;
  std::vector<SurfaceTag> surfaces;
  std::vector<CurveTag> curves;      ///< one of each of the mesh's curves
  std::optional<CornerTag> corners;  ///< if there are any
  std::vector<std::uint32_t> volume_of_tet;
  std::vector<std::uint32_t> surface_of_facet;
  std::vector<std::size_t> tets_in;         ///< one a volume: how many tets
  std::vector<std::size_t> facets_in;       ///< one a surface: how many facets
  std::vector<std::size_t> edges_in;        ///< one a curve: how many edges
  int last_tag = 0;                         ///< the largest of all
  std::vector<std::string> material_names;  ///< one a material of the mesh, plain and distinct
  std::vector<std::string> set_names;       ///< one of each of the mesh's sets: its name, made plain and distinct

  /// All names of groups and of sets.
  std::vector<std::string> names() const;
};

/// Names of the mesh's own that look like those which others of its groups have without one get "_named" behind, for
/// readers would take them for these: "region_2" of region 1, a set "corners".
MeshTags make_tags(const TetMesh& mesh);

/// Whether groups of some mesh are called so if they have no names of their own, in letters of either case: region_3;
/// boundary_3_0; curve_0_1_2 or corners. A number may stand behind for there were two of the name; -3 may be m3.
bool is_region_name(std::string_view name);
bool is_boundary_name(std::string_view name);
bool is_curve_name(std::string_view name);

/// The tets of one region and one material, for formats where an element is of one group alone.
struct PartTag {
  std::uint32_t volume;                   ///< of MeshTags::volumes
  std::optional<std::uint32_t> material;  ///< of the mesh's; none if it has none
  int tag;                                ///< the volume's if there are no materials, else above all others
  std::string name;                       ///< likewise
};
struct MeshParts {
  std::vector<PartTag> parts;
  std::vector<std::uint32_t> part_of_tet;
  std::vector<std::size_t> tets_in;
};
MeshParts make_parts(const TetMesh& mesh, const MeshTags& tags);

/// The mesh's sets under their names, and behind them the tets of each material as one, "material_soft".
struct NamedSet {
  std::string name;
  MeshSet set;
};
std::vector<NamedSet> sets_and_materials(const TetMesh& mesh, const MeshTags& tags);

/// Indices 0 … group_of.size() - 1 ordered by group, ascending inside a group.
std::vector<std::uint32_t> order_by_group(const std::vector<std::uint32_t>& group_of,
                                          const std::vector<std::size_t>& size_of);

/// Calls `take(groups[g], its members ascending)` for each group g in turn, where group_of says the group of each.
template <typename Group, typename Take>
void for_each_group(const std::vector<Group>& groups, const std::vector<std::uint32_t>& group_of,
                    const std::vector<std::size_t>& size_of, const Take& take) {
  const std::vector<std::uint32_t> order = order_by_group(group_of, size_of);
  std::size_t first = 0;
  for (std::size_t g = 0; g < groups.size(); first += size_of[g++]) {
    take(groups[g], std::span<const std::uint32_t>(order).subspan(first, size_of[g]));
  }
}

/// Calls `take(volume, indices of its tets)` for each region.
template <typename Take>
void for_each_region(const MeshTags& tags, const Take& take) {
  for_each_group(tags.volumes, tags.volume_of_tet, tags.tets_in, take);
}

/// Calls `take(surface, indices of its facets)` for each pair of regions.
template <typename Take>
void for_each_surface(const MeshTags& tags, const Take& take) {
  for_each_group(tags.surfaces, tags.surface_of_facet, tags.facets_in, take);
}

/// For each vertex 1 if one of these tets has it, else 0.
std::vector<std::uint8_t> vertices_of_tets(const TetMesh& mesh, std::span<const std::uint32_t> tets);

}  // namespace scantet
