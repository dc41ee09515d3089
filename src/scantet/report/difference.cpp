// One walk makes the rows; text, JSON and the page show the same.
#include "scantet/report/difference.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "scantet/report/chart_impl.h"
#include "scantet/report/distances_impl.h"
#include "scantet/report/numbers_impl.h"
#include "scantet/report/report_json_impl.h"

namespace scantet {
namespace {

using Json = nlohmann::ordered_json;

std::string with_sign(double value) {
  return (value < 0 ? "-" : "+") + number(std::abs(value));
}

class Rows {
 public:
  void add(const std::string& what, double a, double b) {
    const double change = b - a;
    std::string text;
    if (change != 0 && std::isfinite(change)) {
      text = with_sign(change);
      const double percent = 100 * change / std::abs(a);
      if (std::isfinite(percent)) text += " (" + with_sign(percent) + " %)";
    }
    rows_.push_back({what, {number(a), number(b)}, text});
  }
  void add(const std::string& what, std::uint64_t a, std::uint64_t b) {
    std::string text;
    if (a != b) text = (a < b ? "+" : "-") + grouped(a < b ? b - a : a - b);
    rows_.push_back({what, {grouped(a), grouped(b)}, text});
  }
  void add_words(const std::string& what, const std::string& a, const std::string& b) {
    rows_.push_back({what, {a, b}, ""});
  }
  std::vector<DifferenceRow> take() { return std::move(rows_); }

 private:
  std::vector<DifferenceRow> rows_;
};

void add_quality(const QualitySummary& a, const QualitySummary& b, Rows& rows) {
  constexpr std::size_t kMedian = 3;
  static_assert(kPercentiles[kMedian] == 50);
  rows.add("smallest dihedral angle, deg", a.min_dihedral_deg(), b.min_dihedral_deg());
  rows.add("dihedral angles, 1st percentile", a.dihedral_deg.percentiles[0], b.dihedral_deg.percentiles[0]);
  rows.add("largest dihedral angle, deg", a.max_dihedral_deg(), b.max_dihedral_deg());
  rows.add("tets under 10 deg", a.tets_under_deg[1], b.tets_under_deg[1]);
  rows.add("boundary angles from, deg", a.min_facet_angle_deg, b.min_facet_angle_deg);
  rows.add("least scaled Jacobian", a.scaled_jacobian.min, b.scaled_jacobian.min);
  rows.add("mean scaled Jacobian", a.scaled_jacobian.mean, b.scaled_jacobian.mean);
  rows.add("mean inverse aspect ratio", a.inverse_aspect.mean, b.inverse_aspect.mean);
  rows.add("radius-edge ratio up to", a.max_radius_edge(), b.max_radius_edge());
  rows.add("shortest edge, mm", a.edge_length_mm.min, b.edge_length_mm.min);
  rows.add("median edge, mm", a.edge_length_mm.percentiles[kMedian], b.edge_length_mm.percentiles[kMedian]);
  rows.add("longest edge, mm", a.edge_length_mm.max, b.edge_length_mm.max);
  rows.add("least height, mm", a.min_height_mm.min, b.min_height_mm.min);
}

void add_topology(const AuditReport& a, const AuditReport& b, Rows& rows) {
  rows.add("components", static_cast<std::uint64_t>(a.components.size()),
           static_cast<std::uint64_t>(b.components.size()));
  rows.add("cavities", a.cavities, b.cavities);
  rows.add("Euler number of the boundary", static_cast<double>(a.boundary_euler),
           static_cast<double>(b.boundary_euler));
  const auto verdict = [](const AuditReport& audit) {
    return audit.passed() ? std::string("passed") : counted(audit.findings.size(), "fault", "faults");
  };
  rows.add_words("audit", verdict(a), verdict(b));
}

std::string worst_of(const OneWayDistance& distance) {
  return distance_text(distance) + (distance.worst.empty() || distance.lower_mm == 0
                                        ? ""
                                        : ", the farthest at " + place_text(distance.worst.front().point));
}

Json json_of(const Point& p) {
  return {p.x, p.y, p.z};
}

Json json_of(const OneWayDistance& d) {
  Json json{{"lower_mm", d.lower_mm}, {"upper_mm", nullptr}, {"points", d.points}, {"worst", Json::array()}};
  if (d.upper_mm) json["upper_mm"] = *d.upper_mm;
  for (const FarPlace& place : d.worst) {
    json["worst"].push_back({{"distance_mm", place.distance_mm}, {"place_mm", json_of(place.point)}});
  }
  return json;
}

const char* key_of(Sameness same) {
  constexpr std::array kKeys{"arrays", "numbering", "tets", "none"};
  return kKeys.at(static_cast<std::size_t>(same));
}

Json json_of(const AttachedDifference& attached) {
  Json json{{"paired", attached.is_paired},
            {"one_to_one", attached.is_one_to_one},
            {"edge_nodes", nullptr},
            {"sets", Json::array()},
            {"fields", Json::array()}};
  if (const auto& nodes = attached.edge_nodes) {
    json["edge_nodes"] = {{"largest_mm", nodes->largest_mm},
                          {"places_mm", {json_of(nodes->places[0]), json_of(nodes->places[1])}}};
  }
  for (const SetDifference& set : attached.sets) {
    Json entry{{"name", set.name}, {"of", set.of}, {"members", set.members}, {"alone", nullptr}, {"place_mm", nullptr}};
    if (set.alone) entry["alone"] = *set.alone;
    if (set.place) entry["place_mm"] = json_of(*set.place);
    json["sets"].push_back(std::move(entry));
  }
  for (const FieldDifference& field : attached.fields) {
    json["fields"].push_back({{"name", field.name},
                              {"largest", field.largest},
                              {"scale", field.scale},
                              {"values", field.values},
                              {"place_mm", json_of(field.place)}});
  }
  return json;
}

void add_attached(const AttachedDifference& attached, Rows& rows) {
  if (const auto& nodes = attached.edge_nodes) {
    const auto text = [&](const Point& place) {
      return number(nodes->largest_mm) + " mm" + (nodes->largest_mm > 0 ? ", at " + place_text(place) : "");
    };
    rows.add_words("nodes on edges, farthest from the other's", text(nodes->places[0]), text(nodes->places[1]));
  }
  for (const SetDifference& set : attached.sets) {
    const std::string head = "set " + set.name + ": " + set.of;
    rows.add(head, set.members[0], set.members[1]);
    if (set.alone && !set.is_same()) rows.add(head + " that the other has not", (*set.alone)[0], (*set.alone)[1]);
  }
  for (const FieldDifference& field : attached.fields) {
    if (field.largest > 0)
      rows.add("field " + field.name + ": where it differs most", field.values[0], field.values[1]);
  }
}

}  // namespace

std::string place_text(const Point& place) {
  return "(" + number(place.x) + ", " + number(place.y) + ", " + number(place.z) + ") mm";
}

std::string difference_verdict(const ReportDifference& difference) {
  if (!difference.is_same()) return "different: " + difference.reasons.front();
  if (difference.same_bytes) return "the same: the files have the same bytes";
  const AttachedDifference& attached = difference.attached;
  std::string within;
  if (attached.edge_nodes && attached.edge_nodes->largest_mm > 0) {
    within += "; nodes on edges within " + number(attached.edge_nodes->largest_mm) + " mm";
  }
  const auto differs = [](const FieldDifference& field) { return field.largest > 0; };
  if (std::any_of(attached.fields.begin(), attached.fields.end(), differs)) {
    within += "; values of fields within " + number(difference.field_tolerance) + " of the greatest";
  }
  const std::string same = text_of(difference.mesh.same);
  if (difference.mesh.same <= Sameness::numbering) return "the same: " + same + within;
  return "the same within " + number(difference.tolerance_mm) + " mm: boundaries and volumes; " + same + " inside" +
         within;
}

std::vector<DifferenceRow> difference_rows(const ReportDifference& difference, std::span<const Report> reports) {
  Rows rows;
  const Report& a = reports[0];
  const Report& b = reports[1];
  if (a.mesh && b.mesh) {
    rows.add("vertices", a.mesh->vertices, b.mesh->vertices);
    rows.add("tets", a.mesh->tets, b.mesh->tets);
    rows.add("tets that the other has not", difference.mesh.tets_alone[0], difference.mesh.tets_alone[1]);
    rows.add("boundary facets", a.mesh->boundary_facets, b.mesh->boundary_facets);
    rows.add("volume, mm^3", a.mesh->volume_mm3, b.mesh->volume_mm3);
  }
  for (const RegionDifference& region : difference.mesh.regions) {
    const auto& [in_a, in_b] = region.sides;
    const std::string head = "region " + std::to_string(region.region) + ": ";
    if (in_a.name != in_b.name) rows.add_words(head + "name", in_a.name, in_b.name);
    rows.add(head + "tets", in_a.tets, in_b.tets);
    rows.add(head + "volume, mm^3", in_a.volume_mm3, in_b.volume_mm3);
    rows.add(head + "area around, mm^2", in_a.area_mm2, in_b.area_mm2);
  }
  rows.add_words("farthest from the other's boundary", worst_of(difference.mesh.to_second),
                 worst_of(difference.mesh.to_first));
  add_attached(difference.attached, rows);
  if (a.quality && b.quality) add_quality(*a.quality, *b.quality, rows);
  if (a.audit && b.audit) add_topology(*a.audit, *b.audit, rows);
  if (!difference.not_compared[0].empty() || !difference.not_compared[1].empty()) {
    const auto text = [](const std::string& left_out) { return left_out.empty() ? "nothing" : left_out; };
    rows.add_words("not compared", text(difference.not_compared[0]), text(difference.not_compared[1]));
  }
  if (difference.provenance[0] != difference.provenance[1]) {
    rows.add_words("made by", difference.provenance[0], difference.provenance[1]);
  }
  return rows.take();
}

std::string difference_text(const ReportDifference& difference, std::span<const Report> reports) {
  constexpr std::size_t kLongest = 22;  // a value that is longer goes to lines of its own
  const std::vector<std::string> names = mesh_names(reports);
  std::string text = difference_verdict(difference) + "\n";
  for (std::size_t i = 1; i < difference.reasons.size(); ++i) text += "           " + difference.reasons[i] + "\n";
  text += "\nA  " + names[0] + "\nB  " + names[1] + "\n\n";
  std::size_t label = 0;
  const std::vector<DifferenceRow> rows = difference_rows(difference, reports);
  for (const DifferenceRow& row : rows) label = std::max(label, row.what.size() + 2);
  const auto padded = [](const std::string& value, std::size_t width) {
    return value + std::string(value.size() < width ? width - value.size() : 1, ' ');
  };
  text += padded("", label) + padded("A", kLongest + 2) + padded("B", kLongest + 2) + "B - A\n";
  for (const DifferenceRow& row : rows) {
    std::string line = padded(row.what, label);
    if (row.values[0] == row.values[1]) {
      line += row.values[0];
    } else if (std::max(row.values[0].size(), row.values[1].size()) > kLongest) {
      line += "A: " + row.values[0] + "\n" + padded("", label) + "B: " + row.values[1];
    } else {
      line += padded(row.values[0], kLongest + 2) + padded(row.values[1], kLongest + 2) + row.change;
    }
    line.resize(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string difference_json(const ReportDifference& difference, std::span<const Report> reports) {
  const MeshDifference& mesh = difference.mesh;
  Json json{{"same", difference.is_same()},
            {"verdict", difference_verdict(difference)},
            {"reasons", difference.reasons},
            {"same_bytes", difference.same_bytes},
            {"sameness", key_of(mesh.same)},
            {"tolerance_mm", difference.tolerance_mm},
            {"field_tolerance", difference.field_tolerance},
            {"tets_alone", mesh.tets_alone},
            {"to_second", json_of(mesh.to_second)},
            {"to_first", json_of(mesh.to_first)},
            {"regions", Json::array()},
            {"patches", Json::array()},
            {"attached", json_of(difference.attached)},
            {"not_compared", difference.not_compared},
            {"provenance", difference.provenance},
            {"meshes", Json::array()}};
  for (const RegionDifference& region : mesh.regions) {
    Json sides = Json::array();
    for (const RegionDifference::Side& side : region.sides) {
      sides.push_back(
          {{"name", side.name}, {"tets", side.tets}, {"volume_mm3", side.volume_mm3}, {"area_mm2", side.area_mm2}});
    }
    json["regions"].push_back({{"region", region.region}, {"sides", std::move(sides)}});
  }
  for (const PatchDifference& patch : mesh.patches) {
    json["patches"].push_back({{"regions", patch.regions}, {"facets", patch.facets}, {"area_mm2", patch.area_mm2}});
  }
  for (const Report& report : reports) json["meshes"].push_back(json_of(report));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace scantet
