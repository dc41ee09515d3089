#include <nlohmann/json.hpp>

#include "scantet/certificate/certificate_json_impl.h"

namespace scantet {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(const Point& p) {
  return {p.x, p.y, p.z};
}

ordered_json json_of(const VerifiedDistance& d) {
  ordered_json json{{"lower_mm", d.lower_mm}, {"lower_place", json_of(d.lower_place)}};
  json["upper_mm"] = d.upper_mm ? ordered_json(*d.upper_mm) : ordered_json();
  json["upper_place"] = json_of(d.upper_place);
  return json;
}

ordered_json json_of(const VerifiedInvariants& i) {
  return {{"components", i.components},
          {"cavities", i.cavities},
          {"euler", i.euler},
          {"handles", i.handles()},
          {"known", i.is_known}};
}

ordered_json json_of(const std::vector<VerifyFinding>& findings) {
  ordered_json list = ordered_json::array();
  for (const VerifyFinding& f : findings) {
    list.push_back({{"code", f.code},
                    {"message", f.what},
                    {"wrong", f.is_wrong},
                    {"count", f.count},
                    {"place", json_of(f.place)}});
  }
  return list;
}

ordered_json json_of(const std::vector<LeftOutPart>& parts) {
  ordered_json list = ordered_json::array();
  for (const LeftOutPart& part : parts) {
    list.push_back({{"kind", part.is_cavity ? "cavity" : "component"},
                    {"place", json_of(part.place)},
                    {"volume_mm3", part.volume_mm3}});
  }
  return list;
}

ordered_json json_of(const VerifiedRegion& r) {
  return {{"region", r.region},
          {"voxels", r.voxels},
          {"voxels_kept", r.voxels_kept},
          {"voxels_on_face", r.voxels_on_face},
          {"field_components", r.field_components},
          {"mesh_components", r.mesh_components},
          {"mesh_to_field", json_of(r.mesh_to_field)},
          {"field_to_mesh", json_of(r.field_to_mesh)},
          {"field_volume_mm3", r.field_volume_mm3},
          {"mesh_volume_mm3", r.mesh_volume_mm3}};
}

/// Of a label map.
ordered_json json_of_regions(const Certificate& c) {
  ordered_json json{{"grade", name_of(c.grade)}, {"findings", json_of(c.findings)}, {"tets", c.tets}};
  json["facets"] = {{"count", c.facets}};
  json["mesh_to_field"] = json_of(c.mesh_to_level);
  json["field_to_mesh"] = json_of(c.level_to_mesh);
  json["regions"] = ordered_json::array();
  for (const VerifiedRegion& region : c.regions) json["regions"].push_back(json_of(region));
  json["seconds"] = c.seconds;
  return json;
}

/// Of a closed surface.
ordered_json json_of_surface(const Certificate& c) {
  ordered_json json{{"grade", name_of(c.grade)}, {"findings", json_of(c.findings)}, {"tets", c.tets}};
  json["facets"] = {{"count", c.facets}, {"area_mm2", c.area_mm2}};
  json["mesh_to_surface"] = json_of(c.mesh_to_level);
  json["surface_to_mesh"] = json_of(c.level_to_mesh);
  json["surface_topology"] = json_of(c.field);
  json["mesh_topology"] = json_of(c.mesh);
  json["surface_volume_mm3"] = c.field_volume_mm3;
  json["mesh_volume_mm3"] = c.mesh_volume_mm3;
  json["seconds"] = c.seconds;
  return json;
}

}  // namespace

ordered_json json_of(const Certificate& c) {
  if (!c.regions.empty()) return json_of_regions(c);
  if (c.is_of_surface) return json_of_surface(c);
  ordered_json json{{"grade", name_of(c.grade)}};
  json["findings"] = json_of(c.findings);
  json["tets"] = c.tets;
  json["facets"] = {{"count", c.facets},
                    {"certified", c.facets_certified},
                    {"beyond_outermost_voxels", c.facets_at_border},
                    {"area_mm2", c.area_mm2},
                    {"area_certified_mm2", c.area_certified_mm2}};
  json["mesh_to_level"] = json_of(c.mesh_to_level);
  json["level_to_mesh"] = json_of(c.level_to_mesh);
  json["field_topology"] = json_of(c.field);
  json["mesh_topology"] = json_of(c.mesh);
  json["left_out"] = {
      {"components", c.components_left_out}, {"cavities_filled", c.cavities_filled}, {"parts", json_of(c.left_out)}};
  json["field_volume_mm3"] = c.field_volume_mm3;
  json["mesh_volume_mm3"] = c.mesh_volume_mm3;
  ordered_json places = ordered_json::array();
  for (const UndecidedPlace& place : c.undecided) {
    places.push_back({{"reason", place.reason}, {"min", json_of(place.box.min)}, {"max", json_of(place.box.max)}});
  }
  json["undecided"] = places;
  json["seconds"] = c.seconds;
  return json;
}

ordered_json json_of(const MeshCertificate& certificate) {
  if (certificate.certificates.size() == 1) return json_of(certificate.certificates.front());
  ordered_json json{{"grade", name_of(certificate.grade())}, {"levels", ordered_json::array()}};
  for (std::size_t n = 0; n < certificate.certificates.size(); ++n) {
    ordered_json level{{"level", certificate.levels[n]}};
    level.update(json_of(certificate.certificates[n]));
    json["levels"].push_back(level);
  }
  return json;
}

}  // namespace scantet
