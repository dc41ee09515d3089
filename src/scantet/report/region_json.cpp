// Keys as report_forms.h lists them.
#include "scantet/report/report_json_impl.h"

namespace scantet {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

nlohmann::ordered_json json_of_places(const std::vector<Point>& places) {
  Json json = Json::array();
  for (const Point& place : places) json.push_back({place.x, place.y, place.z});
  return json;
}

nlohmann::ordered_json region_json(const ReportRegion& r) {
  const auto value = [](const std::optional<double>& number) { return number ? Json(*number) : Json(nullptr); };
  Json json{{"region", r.region}, {"name", r.name}};
  if (r.region != kOutside) {
    const bool meshed = r.mesh.tets > 0;
    json["color"] = color_text(r.color);
    json["tets"] = r.mesh.tets;
    json["volume_mm3"] = r.mesh.volume_mm3;
    json["min_dihedral_deg"] = meshed ? Json(r.mesh.min_dihedral_deg) : Json(nullptr);
    json["max_dihedral_deg"] = meshed ? Json(r.mesh.max_dihedral_deg) : Json(nullptr);
    json["components"] = r.components;
    json["area_mm2"] = r.area_mm2();
    json["neighbors"] = Json::array();
    for (const ReportNeighbor& n : r.neighbors) {
      json["neighbors"].push_back({{"region", n.region}, {"area_mm2", n.area_mm2}, {"facets", n.facets}});
    }
  }
  if (!r.grid) return json;
  json["voxels"] = r.grid->grid.nodes;
  json["voxels_kept"] = r.grid->kept;
  json["lost_voxels_mm"] = json_of_places(r.grid->lost);
  if (r.region == kOutside) return json;
  json["voxels_mm3"] = r.voxels_mm3;
  json["off_voxels_percent"] = value(r.off_voxels_percent());
  json["field_mm3"] = r.is_whole() ? Json(r.grid->grid.volume_mm3) : Json(nullptr);
  json["off_field_percent"] = value(r.off_field_percent());
  json["field_components"] = r.grid->parts;
  return json;
}

}  // namespace scantet
