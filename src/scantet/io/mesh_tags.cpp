// Regions are few and tets many: distinct values are collected by skipping repeats, then looked up by bisection.
#include <algorithm>
#include <numeric>

#include "scantet/base/ascii_text.h"
#include "scantet/base/element_nodes.h"
#include "scantet/io/file_names.h"
#include "scantet/io/mesh_tags_impl.h"
#include "scantet/io/taken_names_impl.h"

namespace scantet {
namespace {

template <typename T>
std::vector<T> distinct(const std::vector<T>& values) {
  std::vector<T> found;
  for (const T& value : values) {
    const auto place = std::lower_bound(found.begin(), found.end(), value);
    if (place == found.end() || *place != value) found.insert(place, value);
  }
  return found;
}

template <typename T>
std::vector<std::uint32_t> index_in(const std::vector<T>& values, const std::vector<T>& groups) {
  std::vector<std::uint32_t> index;
  index.reserve(values.size());
  for (const T& value : values) {
    index.push_back(static_cast<std::uint32_t>(std::lower_bound(groups.begin(), groups.end(), value) - groups.begin()));
  }
  return index;
}

std::vector<std::size_t> count(const std::vector<std::uint32_t>& group_of, std::size_t groups) {
  std::vector<std::size_t> sizes(groups, 0);
  for (std::uint32_t group : group_of) ++sizes[group];
  return sizes;
}

/// Abaqus does not tell a from A.
/// A name as every format takes it: letters, digits and _ - . after a letter.
std::string plain_name(const std::string& name) {
  std::string plain;
  for (const char c : name) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool is_other = (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
    if (plain.empty() && !is_letter) plain += "n_";
    plain += is_letter || is_other ? c : '_';
  }
  return plain;
}

/// The same, and as none in `taken`, to which it is added.
std::string tag_name(const std::string& name, TakenNames& taken) {
  return taken.distinct(plain_name(name));
}

/// The same, with "_named" behind a name that is not `otherwise`, what the group is called without one, but looks as
/// if it were another's, in Abaqus files also for these have neither - nor . in names.
std::string own_tag_name(const std::string& name, const std::string& otherwise, bool (*is_of_others)(std::string_view),
                         TakenNames& taken) {
  const std::string plain = plain_name(name);
  std::string of_abaqus = plain;
  std::replace_if(
      of_abaqus.begin(), of_abaqus.end(), [](char c) { return c == '-' || c == '.'; }, '_');
  const auto misleads = [&](const std::string& text) {
    return is_of_others(text) && ascii_upper(text) != ascii_upper(otherwise);
  };
  return tag_name(misleads(plain) || misleads(of_abaqus) ? plain + "_named" : plain, taken);
}

bool is_name_of_any(std::string_view name) {
  return is_region_name(name) || is_boundary_name(name) || is_curve_name(name);
}

/// How many whole numbers follow `prefix`, in capitals, with "_" between them; 0 if that is not all of the name.
std::size_t numbers_behind(std::string_view prefix, std::string_view name) {
  const std::string text = ascii_upper(name);
  std::string_view rest = text;
  if (!rest.starts_with(prefix)) return 0;
  rest.remove_prefix(prefix.size());
  for (std::size_t numbers = 1;; ++numbers) {
    if (rest.starts_with('-') || rest.starts_with('M')) rest.remove_prefix(1);
    const std::size_t digits = std::min(rest.find_first_not_of("0123456789"), rest.size());
    if (digits == 0) return 0;
    rest.remove_prefix(digits);
    if (rest.empty()) return numbers;
    if (rest.front() != '_') return 0;
    rest.remove_prefix(1);
  }
}

MeshPatch patch_of_pair(const TetMesh& mesh, const std::array<Region, 2>& pair) {
  const auto known = std::find_if(mesh.patches.begin(), mesh.patches.end(),
                                  [&](const MeshPatch& patch) { return patch.regions == pair; });
  return known == mesh.patches.end() ? MeshPatch{pair, {}} : *known;
}

/// Curves and corners come last, so that nothing else has another name for their sake.
void add_curves(const TetMesh& mesh, TakenNames& taken, MeshTags& tags) {
  for (const MeshCurve& curve : mesh.curves) {
    const std::string name =
        own_tag_name(curve_name(curve), curve_name({curve.regions, "", false}), is_curve_name, taken);
    tags.curves.push_back({curve.regions, ++tags.last_tag, name, !curve.name.empty(), curve.is_sharp});
  }
  if (!mesh.corners.empty()) tags.corners = CornerTag{++tags.last_tag, tag_name("corners", taken)};
  tags.edges_in = count(mesh.edge_curves, mesh.curves.size());
}

}  // namespace

bool is_region_name(std::string_view name) {
  return numbers_behind("REGION_", name) == 1;
}

bool is_boundary_name(std::string_view name) {
  const std::size_t numbers = numbers_behind("BOUNDARY_", name);
  return numbers == 2 || numbers == 3;
}

bool is_curve_name(std::string_view name) {
  return ascii_upper(name) == "CORNERS" || numbers_behind("CURVE_", name) >= 2;
}

TagNames tag_names(const TetMesh& mesh) {
  const MeshTags tags = make_tags(mesh);
  TagNames names{{}, tags.set_names};
  for (const VolumeTag& volume : tags.volumes) names.regions[volume.region] = volume.name;
  return names;
}

std::vector<std::string> MeshTags::names() const {
  std::vector<std::string> all;
  for (const VolumeTag& volume : volumes) all.push_back(volume.name);
  for (const SurfaceTag& surface : surfaces) all.push_back(surface.name);
  for (const CurveTag& curve : curves) all.push_back(curve.name);
  if (corners) all.push_back(corners->name);
  all.insert(all.end(), set_names.begin(), set_names.end());
  return all;
}

MeshTags make_tags(const TetMesh& mesh) {
  MeshTags tags;
  TakenNames taken;
  const std::vector<Region> regions = distinct(mesh.tet_regions);
  constexpr Region kLargestTag = 1'000'000'000;  // leaves room for the surfaces in an int
  const bool as_they_are = regions.empty() || (regions.front() > 0 && regions.back() <= kLargestTag);
  int next = 1;
  for (Region region : regions) {
    const int tag = as_they_are ? region : next;
    const bool is_named = mesh.region_names.count(region) > 0;
    const std::string otherwise = "region_" + std::to_string(region);
    const std::string name = own_tag_name(region_name(mesh, region), otherwise, is_region_name, taken);
    tags.volumes.push_back({region, tag, name, is_named});
    next = tag + 1;
  }
  const bool has_patches = mesh.facet_patches.size() == mesh.facet_regions.size() && !mesh.patches.empty();
  const auto pairs = has_patches ? std::vector<std::array<Region, 2>>() : distinct(mesh.facet_regions);
  std::vector<MeshPatch> patches = mesh.patches;
  if (!has_patches) {
    patches.clear();
    for (const auto& pair : pairs) patches.push_back(patch_of_pair(mesh, pair));
  }
  for (const MeshPatch& patch : patches) {
    const std::string name = own_tag_name(patch_name(patch), patch_name({patch.regions, ""}), is_boundary_name, taken);
    tags.surfaces.push_back({patch.regions, next++, name, !patch.name.empty()});
  }
  TakenNames taken_by_materials;
  for (const MeshMaterial& material : mesh.materials) {
    tags.material_names.push_back(tag_name(material.name, taken_by_materials));
  }
  for (const MeshSet& set : mesh.sets) tags.set_names.push_back(own_tag_name(set.name, "", is_name_of_any, taken));
  tags.last_tag = next - 1;
  add_curves(mesh, taken, tags);
  tags.volume_of_tet = index_in(mesh.tet_regions, regions);
  tags.surface_of_facet = has_patches ? mesh.facet_patches : index_in(mesh.facet_regions, pairs);
  tags.tets_in = count(tags.volume_of_tet, regions.size());
  tags.facets_in = count(tags.surface_of_facet, tags.surfaces.size());
  return tags;
}

MeshParts make_parts(const TetMesh& mesh, const MeshTags& tags) {
  MeshParts parts;
  if (mesh.materials.empty()) {
    for (std::uint32_t v = 0; v < tags.volumes.size(); ++v) {
      parts.parts.push_back({v, std::nullopt, tags.volumes[v].tag, tags.volumes[v].name});
    }
    parts.part_of_tet = tags.volume_of_tet;
    parts.tets_in = tags.tets_in;
    return parts;
  }
  using Pair = std::array<std::uint32_t, 2>;
  std::vector<Pair> of_tets;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    of_tets.push_back({tags.volume_of_tet[t], mesh.tet_materials[t]});
  }
  const std::vector<Pair> pairs = distinct(of_tets);
  TakenNames taken;
  for (const std::string& name : tags.names()) tag_name(name, taken);
  int tag = tags.last_tag;
  for (const auto& [volume, material] : pairs) {
    parts.parts.push_back(
        {volume, material, ++tag, tag_name(tags.volumes[volume].name + "_" + tags.material_names[material], taken)});
  }
  parts.part_of_tet = index_in(of_tets, pairs);
  parts.tets_in = count(parts.part_of_tet, pairs.size());
  return parts;
}

std::vector<NamedSet> sets_and_materials(const TetMesh& mesh, const MeshTags& tags) {
  std::vector<NamedSet> sets;
  for (std::size_t s = 0; s < mesh.sets.size(); ++s) sets.push_back({tags.set_names[s], mesh.sets[s]});
  TakenNames taken;
  for (const std::string& name : tags.names()) tag_name(name, taken);
  for (const std::string& name : tags.material_names) sets.push_back({tag_name("material_" + name, taken), {}});
  for (std::uint32_t t = 0; t < mesh.tet_materials.size(); ++t) {
    sets[mesh.sets.size() + mesh.tet_materials[t]].set.tets.push_back(t);
  }
  return sets;
}

std::vector<std::uint32_t> order_by_group(const std::vector<std::uint32_t>& group_of,
                                          const std::vector<std::size_t>& size_of) {
  std::vector<std::size_t> next(size_of.size(), 0);
  std::exclusive_scan(size_of.begin(), size_of.end(), next.begin(), std::size_t{0});
  std::vector<std::uint32_t> order(group_of.size());
  for (std::size_t i = 0; i < group_of.size(); ++i) order[next[group_of[i]]++] = static_cast<std::uint32_t>(i);
  return order;
}

std::vector<std::uint8_t> vertices_of_tets(const TetMesh& mesh, std::span<const std::uint32_t> tets) {
  std::vector<std::uint8_t> used(mesh.vertices.size(), 0);
  for (const std::uint32_t tet : tets) {
    for (const VertexId v : nodes_of_tet(mesh, tet)) used[v] = 1;
  }
  return used;
}

}  // namespace scantet
