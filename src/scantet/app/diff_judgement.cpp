// Lengths are held against the tolerance, volumes against it times the area around them; what else there is must be
// equal, as far as both formats hold it, and called the same as far as both formats can call it so.
#include "scantet/app/diff_judgement.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "scantet/check/attached_difference.h"
#include "scantet/io/file_names.h"
#include "scantet/io/mesh_io.h"
#include "scantet/io/mesh_losses.h"

namespace scantet {
namespace {

constexpr double kRounding = 1e-9;  // of a volume

// Whether a set holds the tets of a material, as .msh and .inp have them.
bool is_material_set(const std::string& name) {
  return name.starts_with("material_") || name.starts_with("MATERIAL_");
}

// One kind of members, as SetDifference names it.
struct SetKind {
  const char* of;
  MeshExtra extra;
  bool (*has)(const MeshSet&);
};

constexpr std::array<SetKind, 3> kSetKinds{
    {{"vertices", MeshExtra::node_sets, [](const MeshSet& set) { return !set.vertices.empty(); }},
     {"facets", MeshExtra::facet_sets, [](const MeshSet& set) { return !set.facets.empty(); }},
     {"tets", MeshExtra::tet_sets, [](const MeshSet& set) { return !set.tets.empty(); }}}};

// One of the two files, with the names that are compared.
struct Side {
  const TetMesh* mesh = nullptr;
  const MeshFormat* format = nullptr;
  std::map<Region, std::string> regions;
  std::map<std::string, const MeshSet*> sets;

  std::string name_of(Region region) const {
    const auto named = regions.find(region);
    return named == regions.end() ? "" : named->second;
  }
  void take_sets(const std::vector<std::string>& names) {
    for (std::size_t s = 0; s < names.size(); ++s) sets[names[s]] = &mesh->sets[s];
  }
};
using Sides = std::array<Side, 2>;

// Names as they are in files of one format, else as the stricter format has them.
Sides named_sides(const MeshDifference& found, const std::array<const TetMesh*, 2>& meshes,
                  std::span<const Report> reports) {
  Sides sides;
  for (std::size_t s = 0; s < 2; ++s) {
    sides[s].mesh = meshes[s];
    sides[s].format = mesh_format_of(reports[s].input->path);  // it has been read
  }
  const bool is_one_format = sides[0].format == sides[1].format;
  const bool has_inp = sides[0].format->extension == ".inp" || sides[1].format->extension == ".inp";
  for (std::size_t s = 0; s < 2; ++s) {
    Side& side = sides[s];
    if (is_one_format) {
      for (const RegionDifference& region : found.regions) side.regions[region.region] = region.sides[s].name;
      for (const MeshSet& set : side.mesh->sets) side.sets[set.name] = &set;
    } else if (has_inp) {
      InpNames names = inp_names(*side.mesh);
      side.regions = std::move(names.regions);
      side.take_sets(names.sets);
    } else {
      TagNames names = tag_names(*side.mesh);
      side.regions = std::move(names.regions);
      side.take_sets(names.sets);
    }
  }
  return sides;
}

// What of a file is not judged, told once.
void tell(ReportDifference& difference, std::size_t side, const std::string& what) {
  std::string& told = difference.not_compared[side];
  if (told.find(what) == std::string::npos) told += (told.empty() ? "" : "; ") + what;
}

std::string not_held(const std::string& what, const Side& other) {
  return what + ", which " + other.format->extension + " does not hold";
}

// Forgets names of regions that one of the formats does not hold.
void leave_out_region_names(ReportDifference& difference, Sides& sides) {
  if (sides[0].format->can_hold(MeshExtra::region_names) && sides[1].format->can_hold(MeshExtra::region_names)) return;
  for (std::size_t s = 0; s < 2; ++s) {
    sides[s].regions.clear();
    if (!sides[s].mesh->region_names.empty()) tell(difference, s, not_held("names of regions", sides[1 - s]));
  }
}

// Compares sets again, if some are called alike only as the stricter format has their names.
void compare_sets_of_like_names(ReportDifference& difference, const Sides& sides) {
  TetMesh second;
  bool is_other = false;
  for (const auto& [name, set] : sides[1].sets) {
    second.sets.push_back(*set);
    const auto like = sides[0].sets.find(name);
    if (like == sides[0].sets.end()) continue;
    is_other = is_other || like->second->name != set->name;
    second.sets.back().name = like->second->name;
  }
  if (!is_other) return;
  const TetMesh& mesh = *sides[1].mesh;
  second.vertices = mesh.vertices;
  second.tets = mesh.tets;
  second.tet_regions = mesh.tet_regions;
  second.tet_edge_vertices = mesh.tet_edge_vertices;
  second.boundary_facets = mesh.boundary_facets;
  difference.attached.sets =
      compare_attached(*sides[0].mesh, second, difference.mesh.pairs, difference.tolerance_mm).sets;
}

// Forgets members of sets of a kind that the other format does not hold.
void leave_out_kinds(ReportDifference& difference, const Sides& sides) {
  for (std::size_t s = 0; s < 2; ++s) {
    for (const SetKind& kind : kSetKinds) {
      if (sides[1 - s].format->can_hold(kind.extra)) continue;
      const auto is_lost = [&](const SetDifference& set) { return set.of == kind.of && set.members[1 - s] == 0; };
      if (std::erase_if(difference.attached.sets, is_lost) == 0) continue;
      tell(difference, s, not_held(kind.of + std::string(" of sets"), sides[1 - s]));
    }
  }
}

std::string region_text(const RegionDifference& region) {
  const std::string& name = region.sides[0].name.empty() ? region.sides[1].name : region.sides[0].name;
  return "region " + std::to_string(region.region) + (name.empty() ? "" : " (" + name + ")");
}

std::string mm(double value) {
  return number_text(value, 4) + " mm";
}

void judge_regions(const MeshDifference& found, double tolerance_mm, const Sides& sides,
                   std::vector<std::string>& reasons) {
  for (const RegionDifference& region : found.regions) {
    const auto& [a, b] = region.sides;
    if (a.tets == 0 || b.tets == 0) {
      reasons.push_back(region_text(region) + " is in " + (b.tets == 0 ? "A" : "B") + " alone");
      continue;
    }
    if (sides[0].name_of(region.region) != sides[1].name_of(region.region)) {
      reasons.push_back("region " + std::to_string(region.region) + " is called \"" + a.name + "\" in A and \"" +
                        b.name + "\" in B");
    }
    const double off_mm3 = std::abs(b.volume_mm3 - a.volume_mm3);
    const double largest_mm3 = std::max(std::abs(a.volume_mm3), std::abs(b.volume_mm3));
    if (off_mm3 > tolerance_mm * std::max(a.area_mm2, b.area_mm2) + kRounding * largest_mm3) {
      reasons.push_back("the volume of " + region_text(region) + " differs by " + number_text(off_mm3, 4) + " mm^3");
    }
  }
}

void judge_distance(const OneWayDistance& way, const std::string& from, double tolerance_mm,
                    std::vector<std::string>& reasons) {
  const std::string head = "the boundary of " + from + " is ";
  if (way.lower_mm > tolerance_mm) {
    reasons.push_back(head + mm(way.lower_mm) + " from the other's");
  } else if (way.upper_mm && *way.upper_mm > tolerance_mm) {
    reasons.push_back(head + "not proved to be within the tolerance of the other's, only within " + mm(*way.upper_mm));
  }
}

std::string alone_text(const std::string& what, const std::string& name, std::size_t side) {
  return what + " \"" + name + "\" is in " + (side == 0 ? "A" : "B") + " alone";
}

// Whether the mesh has its materials as fields, and not as sets of tets.
bool has_materials_as_fields(const Side& side) {
  const auto is_material = [](const MeshSet& set) { return is_material_set(set.name); };
  const auto tells_materials = [](const MeshField& field) { return field.name == kMaterialFields[0]; };
  const TetMesh& mesh = *side.mesh;
  return std::any_of(mesh.fields.begin(), mesh.fields.end(), tells_materials) &&
         std::none_of(mesh.sets.begin(), mesh.sets.end(), is_material);
}

void judge_set_names(ReportDifference& difference, const Sides& sides, std::vector<std::string>& reasons) {
  for (std::size_t s = 0; s < 2; ++s) {
    const Side& other = sides[1 - s];
    const auto is_held = [&](const SetKind& kind) { return other.format->can_hold(kind.extra); };
    const bool holds_sets = std::any_of(kSetKinds.begin(), kSetKinds.end(), is_held);
    for (const auto& [name, set] : sides[s].sets) {
      if (other.sets.contains(name)) continue;
      const auto can_be = [&, set = set](const SetKind& kind) { return kind.has(*set) && is_held(kind); };
      if (!holds_sets) {
        tell(difference, s, not_held("sets", other));
      } else if (std::none_of(kSetKinds.begin(), kSetKinds.end(), can_be)) {
        for (const SetKind& kind : kSetKinds) {
          if (kind.has(*set)) tell(difference, s, not_held(kind.of + std::string(" of sets"), other));
        }
      } else if (is_material_set(set->name) && sides[s].format != other.format && has_materials_as_fields(other)) {
        tell(difference, s, "sets of materials, which are fields in " + other.format->extension);
      } else {
        reasons.push_back(alone_text("the set", set->name, s));
      }
    }
  }
}

void judge_field_names(ReportDifference& difference, const Sides& sides, std::vector<std::string>& reasons) {
  for (std::size_t s = 0; s < 2; ++s) {
    const Side& other = sides[1 - s];
    std::set<std::string> names;
    for (const MeshField& field : sides[s].mesh->fields) names.insert(field.name);
    for (const MeshField& field : other.mesh->fields) names.erase(field.name);
    if (names.empty()) continue;
    if (!other.format->can_hold(MeshExtra::fields)) {
      tell(difference, s, not_held("fields", other));
      continue;
    }
    for (const std::string& name : names) reasons.push_back(alone_text("the field", name, s));
  }
}

void judge_sets(const AttachedDifference& attached, std::vector<std::string>& reasons) {
  for (const SetDifference& set : attached.sets) {
    if (set.is_same()) continue;
    std::string reason = "the set \"" + set.name + "\" has ";
    if (set.alone) {
      reason += "other " + set.of + ": " + std::to_string((*set.alone)[0]) + " of A are not in B, " +
                std::to_string((*set.alone)[1]) + " of B not in A, one at " + place_text(*set.place);
    } else {
      reason += std::to_string(set.members[0]) + " " + set.of + " in A and " + std::to_string(set.members[1]) + " in B";
    }
    reasons.push_back(reason);
  }
}

void judge_fields(const AttachedDifference& attached, double tolerance, std::vector<std::string>& reasons) {
  for (const FieldDifference& field : attached.fields) {
    if (field.largest <= tolerance * field.scale) continue;
    reasons.push_back("values of the field \"" + field.name + "\" differ by up to " + number_text(field.largest, 4) +
                      ": " + number_text(field.values[0]) + " in A and " + number_text(field.values[1]) + " in B at " +
                      place_text(field.place));
  }
}

// The volume of curved tets is asked for only where there are no nodes to compare.
void judge_order(const ReportDifference& difference, std::span<const Report> reports,
                 std::vector<std::string>& reasons) {
  const auto& a = reports[0].second_order;
  const auto& b = reports[1].second_order;
  if (!a && !b) return;
  if (!a || !b) {
    reasons.push_back(std::string("the tetrahedra of ") + (a ? "A" : "B") + " have ten nodes, those of the other four");
    return;
  }
  if (const auto& nodes = difference.attached.edge_nodes) {
    if (nodes->largest_mm <= difference.tolerance_mm) return;
    reasons.push_back("nodes on edges are up to " + mm(nodes->largest_mm) + " from the other's, so at " +
                      place_text(nodes->places[0]) + " in A");
    return;
  }
  double area_mm2 = 0;
  for (const PatchDifference& patch : difference.mesh.patches) {
    area_mm2 += std::max(patch.area_mm2[0], patch.area_mm2[1]);
  }
  const double off_mm3 = std::abs(b->volume_mm3 - a->volume_mm3);
  const double largest_mm3 = std::max(std::abs(a->volume_mm3), std::abs(b->volume_mm3));
  if (off_mm3 > difference.tolerance_mm * area_mm2 + kRounding * largest_mm3) {
    reasons.push_back("the volume of the curved tetrahedra differs by " + number_text(off_mm3, 4) + " mm^3");
  }
}

void judge_tets(const MeshDifference& found, double tolerance_mm, std::vector<std::string>& reasons) {
  if (found.same <= Sameness::numbering) return;
  if (found.same == Sameness::tets) {
    reasons.emplace_back(text_of(found.same));
  } else if (tolerance_mm == 0) {
    reasons.push_back(std::to_string(found.tets_alone[0]) + " tets of A are not in B, " +
                      std::to_string(found.tets_alone[1]) + " of B not in A");
  }
  judge_distance(found.to_second, "A", tolerance_mm, reasons);
  judge_distance(found.to_first, "B", tolerance_mm, reasons);
}

}  // namespace

std::vector<std::string> reasons_to_differ(ReportDifference& difference, const std::array<const TetMesh*, 2>& meshes,
                                           std::span<const Report> reports) {
  Sides sides = named_sides(difference.mesh, meshes, reports);
  leave_out_region_names(difference, sides);
  compare_sets_of_like_names(difference, sides);
  leave_out_kinds(difference, sides);
  std::vector<std::string> reasons;
  for (std::size_t m = 0; m < 2; ++m) {
    if (meshes[m]->other_solids == 0) continue;
    reasons.push_back(std::string(m == 0 ? "A" : "B") + " holds " + other_solids_text(meshes[m]->other_solids) +
                      ", which cannot be compared");
  }
  judge_tets(difference.mesh, difference.tolerance_mm, reasons);
  if (!difference.attached.is_one_to_one) {
    reasons.emplace_back(
        "the tets are at the same places, but in one mesh several vertices are where the other has one");
  }
  judge_regions(difference.mesh, difference.tolerance_mm, sides, reasons);
  judge_order(difference, reports, reasons);
  judge_set_names(difference, sides, reasons);
  judge_sets(difference.attached, reasons);
  judge_field_names(difference, sides, reasons);
  judge_fields(difference.attached, difference.field_tolerance, reasons);
  return reasons;
}

}  // namespace scantet
