// The keys are a contract (report.h lists them): new ones may be added, none renamed. nlohmann-json writes the shortest
// digits that read back as the same double, and null for NaN and infinity.
#include <algorithm>

#include "scantet/certificate/certificate_json_impl.h"
#include "scantet/report/handles_impl.h"
#include "scantet/report/measures_impl.h"
#include "scantet/report/report_forms.h"
#include "scantet/report/report_json_impl.h"

namespace scantet {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Vec& v) {
  return {v.x, v.y, v.z};
}
Json json_of(const Box& box) {
  return {{"min", json_of(box.min)}, {"max", json_of(box.max)}};
}
Json json_of(const Histogram& h) {
  return {{"edges", h.edges}, {"counts", h.counts}};
}

Json json_of(const Distribution& d) {
  Json json{{"count", d.count}, {"infinite", d.infinite}, {"min", d.min}, {"max", d.max}, {"mean", d.mean}};
  for (std::size_t i = 0; i < kPercentiles.size(); ++i) {
    const std::string percent = std::to_string(kPercentiles[i]);
    json["p" + percent] = d.percentiles[i];
  }
  return json;
}

Json json_of(const ReportInput& input) {
  Json json{{"path", input.path}};
  if (!input.sha256.empty()) json["sha256"] = input.sha256;
  if (input.frame) {
    const Frame& f = *input.frame;
    json["frame"] = {{"origin_mm", json_of(f.origin())},
                     {"columns_mm", {json_of(f.column(0)), json_of(f.column(1)), json_of(f.column(2))}}};
  }
  return json;
}

Json json_of(const std::vector<ReportOption>& options) {
  Json json = Json::object();
  for (const ReportOption& option : options) {
    json[option.name] = std::visit([](const auto& value) { return Json(value); }, option.value);
  }
  return json;
}

Json json_of(const std::vector<RegionVolume>& regions) {
  Json json = Json::array();
  for (const RegionVolume& r : regions) {
    json.push_back({{"region", r.region}, {"tets", r.tets}, {"volume_mm3", r.volume_mm3}});
  }
  return json;
}

Json json_of(const DroppedComponents& c) {
  constexpr std::size_t kListed = 10;
  Json largest = Json::array();
  for (std::size_t i = 0; i < std::min(c.components.size(), kListed); ++i) {
    largest.push_back({{"volume_mm3", c.components[i].volume_mm3},
                       {"witness_mm", json_of(c.components[i].witness)},
                       {"region", c.components[i].region}});
  }
  Json dropped{{"count", c.components.size()}, {"volume_mm3", c.volume_mm3()}, {"largest", std::move(largest)}};
  return {{"found", c.found}, {"dropped", std::move(dropped)}};
}

Json json_of(const ReportTheory& t) {
  return {{"theorem", t.theorem}, {"needed", t.needed}, {"meaning", t.meaning}};
}

Json json_of(const ReportMesh& m) {
  return {{"vertices", m.vertices},
          {"tets", m.tets},
          {"boundary_facets", m.boundary_facets},
          {"boundary_vertices", m.boundary_vertices},
          {"volume_mm3", m.volume_mm3},
          {"regions", json_of(m.regions)}};
}

Json json_of(const std::vector<WorstTet>& tets) {
  Json json = Json::array();
  for (const WorstTet& t : tets) json.push_back({{"tet", t.tet}, {"place_mm", json_of(t.place)}, {"value", t.value}});
  return json;
}

Json json_of(const QualitySummary& q) {
  Json json{{"min_dihedral_deg", q.min_dihedral_deg()},
            {"max_dihedral_deg", q.max_dihedral_deg()},
            {"min_facet_angle_deg", q.min_facet_angle_deg},
            {"max_radius_edge", q.max_radius_edge()},
            {"max_circumradius_mm", q.max_circumradius_mm()},
            {"min_edge_length_mm", q.edge_length_mm.min},
            {"min_height_mm", q.min_height_mm.min},
            {"min_scaled_jacobian", q.scaled_jacobian.min},
            {"min_volume_mm3", q.volume_mm3.min},
            {"median_volume_mm3", q.median_volume_mm3()},
            {"max_stiffness_ratio", q.stiffness_ratio.max},
            {"condition_factor", q.condition_factor},
            {"min_stable_time_step_us", q.stable_time_step_us.min},
            {"wave_speed_m_per_s", q.wave_speed_m_per_s}};
  if (q.edge_size_ratio) json["min_edge_size_ratio"] = q.edge_size_ratio->min;
  Json statistics;
  for (const ReportMeasure& measure : report_measures()) {
    const Distribution* const distribution = measure.distribution(q);
    if (distribution == nullptr) continue;
    json["histograms"][measure.key] = json_of(distribution->histogram);
    statistics[measure.key] = json_of(*distribution);
  }
  json["statistics"] = std::move(statistics);
  for (std::size_t i = 0; i < kSliverDeg.size(); ++i) {
    json["tets_under_deg"][number_text(kSliverDeg[i])] = q.tets_under_deg[i];
  }
  json["regions"] = json_of(q.regions);
  for (const ReportWorst& list : report_worst_lists()) {
    if (!(q.*list.tets).empty()) json["worst"][list.key] = json_of(q.*list.tets);
  }
  return json;
}

Json json_of(const RefinementCounts& r) {
  return {{"r1", r.inserted.r1},
          {"r2", r.inserted.r2},
          {"r3_1", r.inserted.r3_1},
          {"r3_2", r.inserted.r3_2},
          {"unmet", {{"r1", r.unmet.r1}, {"r2", r.unmet.r2}, {"r3", r.unmet.r3}}},
          {"initial_points", r.initial_points},
          {"lattice_points", r.lattice_points},
          {"repair_points", r.repair_points},
          {"absorbed_tets", r.absorbed_tets}};
}

Json json_of(const ReportOptimization& o) {
  Json json{{"target_deg", o.target_deg}, {"tets_below", o.tets_below}, {"stages", Json::array()}};
  for (const OptimizerStage& s : o.stages) {
    json["stages"].push_back({{"stage", s.stage},
                              {"seconds", s.seconds},
                              {"changes", s.changes},
                              {"min_dihedral_before_deg", s.min_dihedral_before_deg},
                              {"min_dihedral_after_deg", s.min_dihedral_after_deg}});
  }
  json["finer"] = {{"places", o.finer_places}};
  if (o.smallest_size_mm) json["finer"]["smallest_size_mm"] = *o.smallest_size_mm;
  return json;
}

Json json_of(const std::vector<ReportBound>& bounds) {
  Json json = Json::array();
  for (const ReportBound& bound : bounds) {
    json.push_back({{"name", bound.name}, {"asked", bound.asked}, {"broken", bound.broken}, {"of", bound.of}});
    if (bound.worst) json.back()["worst"] = *bound.worst;
    if (bound.place) json.back()["place_mm"] = json_of(*bound.place);
  }
  return json;
}

Json json_of(const ReportShortEdges& e) {
  constexpr std::size_t kListed = 100;
  Json json{{"than", e.than}, {"is_bound", e.is_bound},         {"count", e.count},
            {"of", e.of},     {"place_count", e.places.size()}, {"places", Json::array()}};
  for (std::size_t i = 0; i < std::min(e.places.size(), kListed); ++i) {
    const ShortEdgePlace& p = e.places[i];
    json["places"].push_back({{"place_mm", json_of(p.place)}, {"length_mm", p.length_mm}, {"edges", p.edges}});
  }
  return json;
}

Json json_of(const MeshComponent& c) {
  return {{"region", c.region},          {"tets", c.tets},         {"volume_mm3", c.volume_mm3},
          {"box_mm", json_of(c.box_mm)}, {"surfaces", c.surfaces}, {"boundary_euler", c.boundary_euler}};
}

// Of a wall: all but `component`.
Json json_of(const MeshSurface& s, bool manifold, bool of_component) {
  Json json = Json::object();
  if (of_component) json["component"] = s.component;
  json["euler"] = s.euler;
  json["handles"] = manifold ? Json(handles_of(s)) : Json(nullptr);
  json["volume_mm3"] = s.volume_mm3;
  json["box_mm"] = json_of(s.box_mm);
  return json;
}

Json json_of(const Component& c) {
  Json json{{"kind", c.region == kOutside ? "cavity" : "component"}, {"region", c.region}};
  json["witness_mm"] = json_of(c.witness);
  json["box_mm"] = json_of(c.box_mm);
  json["volume_mm3"] = c.volume_mm3 > 0 ? Json(c.volume_mm3) : Json(nullptr);
  return json;
}

Json json_of(const HandleDifference& d) {
  Json json = json_of(d.component);
  const std::optional<std::int64_t> expected = d.component.handles();
  json["handles"] = d.handles();
  json["expected_handles"] = expected ? Json(*expected) : Json(nullptr);
  json["euler"] = d.euler;
  json["expected_euler"] = *d.component.euler;
  return json;
}

Json json_of(const HandleLedger& ledger) {
  const auto value = [](const std::optional<std::int64_t>& number) { return number ? Json(*number) : Json(nullptr); };
  Json json{{"compared", ledger.compared},
            {"compared_cavities", ledger.compared_cavities},
            {"unknown", ledger.unknown},
            {"handles", ledger.handles},
            {"expected_handles", value(ledger.expected_handles)},
            {"euler", ledger.euler},
            {"expected_euler", ledger.expected_euler},
            {"domain_euler", value(ledger.domain_euler)},
            {"different", Json::array()}};
  for (const HandleDifference& difference : ledger.different) json["different"].push_back(json_of(difference));
  return json;
}

Json topology_of(const AuditReport& a) {
  Json json{{"components", a.components.size()},
            {"boundary_components", a.boundary_components},
            {"euler", a.boundary_euler},
            {"manifold", a.manifold()},
            {"cavities", a.cavities},
            {"vertex_components", a.vertex_components},
            {"mesh_euler", a.mesh_euler},
            {"non_manifold_edges", a.non_manifold_edges},
            {"non_manifold_vertices", a.non_manifold_vertices}};
  json["component_list"] = Json::array();
  for (const MeshComponent& component : a.components) json["component_list"].push_back(json_of(component));
  const std::optional<std::int64_t> handles = handles_of(a);
  json["handles"] = handles ? Json(*handles) : Json(nullptr);
  json["surface_list"] = Json::array();
  for (const MeshSurface& s : a.surfaces) json["surface_list"].push_back(json_of(s, a.manifold(), true));
  json["cavity_list"] = Json::array();
  for (const MeshSurface& s : a.cavity_walls) json["cavity_list"].push_back(json_of(s, a.manifold(), false));
  json["interfaces"] = Json::array();
  for (const MeshInterface& i : a.interfaces) {
    json["interfaces"].push_back({{"regions", i.regions},
                                  {"facets", i.facets},
                                  {"surfaces", i.surfaces},
                                  {"euler", i.euler},
                                  {"area_mm2", i.area_mm2},
                                  {"min_angle_deg", i.min_angle_deg},
                                  {"mean_angle_deg", i.mean_angle_deg},
                                  {"min_edge_mm", i.min_edge_mm},
                                  {"mean_edge_mm", i.mean_edge_mm}});
  }
  if (a.ledger) {
    json["expected"] = {{"components", a.ledger->expected_components}, {"cavities", a.ledger->expected_cavities}};
    json["missing"] = Json::array();
    for (const Component& missing : a.ledger->missing) json["missing"].push_back(json_of(missing));
  } else if (has_domain(a) && !knows_parts(a)) {
    json["expected"] = nullptr;
  }
  if (has_domain(a)) json["handle_check"] = a.handle_ledger ? json_of(*a.handle_ledger) : Json(nullptr);
  return json;
}

Json audit_of(const AuditReport& a) {
  Json json{{"passed", a.passed()}, {"complete", a.complete}};
  if (a.max_residual) json["max_residual"] = *a.max_residual;
  if (a.circumcentres_astray) json["circumcentres_astray"] = *a.circumcentres_astray;
  json["findings"] = Json::array();
  for (const Finding& f : a.findings) {
    json["findings"].push_back({{"code", f.code},
                                {"count", f.count},
                                {"message", f.message},
                                {"remedy", f.remedy},
                                {"where_mm", json_of(f.where)},
                                {"places_mm", json_of_places(f.places)}});
  }
  return json;
}

Json json_of(const std::vector<FarPlace>& places) {
  Json json = Json::array();
  for (const FarPlace& place : places) {
    json.push_back({{"distance_mm", place.distance_mm}, {"place_mm", json_of(place.point)}});
  }
  return json;
}

Json json_of(const OneWayDistance& d, bool limited) {
  Json json{{"lower_mm", d.lower_mm},
            {"upper_mm", d.upper_mm ? Json(*d.upper_mm) : Json(nullptr)},
            {"points", d.points},
            {"worst", json_of(d.worst)}};
  if (!limited) return json;
  json["parts"] = d.parts;
  json["beyond"] = d.beyond.size();
  json["undecided"] = d.undecided;
  return json;
}

Json json_of(const BoundaryDistance& d) {
  Json json{{"to_mesh", json_of(d.to_mesh, d.limit_mm.has_value())},
            {"to_surface", json_of(d.to_domain, d.limit_mm.has_value())}};
  if (d.limit_mm) json["limit_mm"] = *d.limit_mm;
  return json;
}

Json json_of(const LayerCheck& c) {
  Json json{{"vertices", c.vertices}, {"broken", c.broken}, {"places", Json::array()}};
  for (const ThinPlace& p : c.places) json["places"].push_back({{"place_mm", json_of(p.place)}, {"layers", p.layers}});
  return json;
}

Json json_of(const ReportCertificate& c) {
  Json json = json_of(c.proved);
  json["file"] = c.file;
  if (c.points_added) json["points_added"] = *c.points_added;
  return json;
}

Json json_of(const ReportTiming& t) {
  Json json = Json::object();
  const auto add = [&](const char* key, const std::optional<double>& seconds) {
    if (seconds) json[key] = *seconds;
  };
  t.for_each_part(add);
  add("total", t.total);
  return json;
}

Json json_of(const std::vector<StageAccount>& stages) {
  Json json = Json::array();
  for (const StageAccount& s : stages)
    json.push_back({{"stage", s.stage}, {"seconds", s.seconds}, {"points", s.points}});
  return json;
}

Json json_of(const std::vector<PhaseAccount>& phases) {
  Json json = Json::array();
  for (const PhaseAccount& p : phases) {
    json.push_back({{"stage", p.stage}, {"part", p.part}, {"seconds", p.seconds}, {"cpu_seconds", p.cpu_seconds}});
  }
  return json;
}

}  // namespace

Json json_of(const Report& report) {
  Json json{{"version", report.version}};
  const auto add = [&](const char* key, const auto& part) {
    if (part) json[key] = json_of(*part);
  };
  add("input", report.input);
  add("options", report.options);
  if (report.stop) json["stop"] = *report.stop;
  if (report.limit) {
    json["limit"] = {{"rule", report.limit->rule},
                     {"place_mm", json_of(report.limit->place)},
                     {"insertion_radius_mm", report.limit->insertion_radius_mm}};
  }
  add("theory", report.theory);
  add("components", report.components);
  add("mesh", report.mesh);
  add("quality", report.quality);
  add("rules", report.rules);
  add("optimization", report.optimization);
  if (!report.bounds.empty()) json["bounds"] = json_of(report.bounds);
  add("short_edges", report.short_edges);
  if (report.audit && report.audit->complete) json["topology"] = topology_of(*report.audit);
  for (const ReportRegion& region : report.regions) json["regions"].push_back(region_json(region));
  if (report.audit) json["audit"] = audit_of(*report.audit);
  if (!report.notes.empty()) json["notes"] = report.notes;
  add("layers", report.layers);
  add("distance", report.distance);
  add("certificate", report.certificate);
  for (const ReportField& field : report.fields) json["fields"].push_back(field_json(field));
  if (report.second_order) json["second_order"] = second_order_json(*report.second_order);
  add("timing_s", report.timing_s);
  for (const ReportFile& file : report.files) json["files"].push_back({{"path", file.path}, {"sha256", file.sha256}});
  if (!report.stages.empty()) json["stages"] = json_of(report.stages);
  if (!report.phases.empty()) json["phases"] = json_of(report.phases);
  return json;
}

std::string json_report(std::span<const Report> reports) {
  Json json;
  if (reports.size() == 1) {
    json = json_of(reports.front());
  } else {
    for (const Report& report : reports) json["meshes"].push_back(json_of(report));
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace scantet
