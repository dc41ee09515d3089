// Lengths are held against the tolerance, volumes against it times the area around them; what else there is must be
// equal.
#include "scantet/app/diff_judgement.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "scantet/io/mesh_io.h"

namespace scantet {
namespace {

constexpr double kRounding = 1e-9;  // of a volume

std::string region_text(const RegionDifference& region) {
  const std::string& name = region.sides[0].name.empty() ? region.sides[1].name : region.sides[0].name;
  return "region " + std::to_string(region.region) + (name.empty() ? "" : " (" + name + ")");
}

std::string mm(double value) {
  return number_text(value, 4) + " mm";
}

void judge_regions(const MeshDifference& found, double tolerance_mm, std::vector<std::string>& reasons) {
  for (const RegionDifference& region : found.regions) {
    const auto& [a, b] = region.sides;
    if (a.tets == 0 || b.tets == 0) {
      reasons.push_back(region_text(region) + " is in " + (b.tets == 0 ? "A" : "B") + " alone");
      continue;
    }
    if (a.name != b.name) {
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

template <class Named>
std::set<std::string> names_of(const std::vector<Named>& all) {
  std::set<std::string> names;
  for (const Named& one : all) names.insert(one.name);
  return names;
}

// What files may hold beside regions.
void judge_names(const std::string& what, const std::set<std::string>& a, const std::set<std::string>& b,
                 std::vector<std::string>& reasons) {
  for (const auto& [mine, theirs, which] : {std::tuple{&a, &b, "A"}, std::tuple{&b, &a, "B"}}) {
    for (const std::string& name : *mine) {
      if (theirs->count(name) == 0) reasons.push_back(what + " \"" + name + "\" is in " + which + " alone");
    }
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

std::vector<std::string> reasons_to_differ(const ReportDifference& difference,
                                           const std::array<const TetMesh*, 2>& meshes,
                                           std::span<const Report> reports) {
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
  judge_regions(difference.mesh, difference.tolerance_mm, reasons);
  judge_order(difference, reports, reasons);
  judge_names("the set", names_of(meshes[0]->sets), names_of(meshes[1]->sets), reasons);
  judge_sets(difference.attached, reasons);
  judge_names("the field", names_of(meshes[0]->fields), names_of(meshes[1]->fields), reasons);
  judge_fields(difference.attached, difference.field_tolerance, reasons);
  return reasons;
}

}  // namespace scantet
