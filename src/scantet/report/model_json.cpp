// Keys as docs/fields.md and docs/second_order.md list them.
#include "scantet/report/report_json_impl.h"

namespace scantet {

nlohmann::ordered_json field_json(const ReportField& f) {
  return {{"name", f.name}, {"scan", f.scan}, {"measure", f.measure}, {"min", f.min},
          {"max", f.max},   {"mean", f.mean}, {"total", f.total},     {"tets_outside", f.tets_outside}};
}

nlohmann::ordered_json second_order_json(const ReportSecondOrder& s) {
  nlohmann::ordered_json json{{"edges", s.edges}, {"boundary_edges", s.boundary_edges}};
  if (s.on_boundary) json["on_boundary"] = *s.on_boundary;
  if (s.eased_edges) json["eased_edges"] = *s.eased_edges;
  if (s.eased_tets) json["eased_tets"] = *s.eased_tets;
  json["unproved"] = s.unproved;
  json["least_share"] = s.least_share;
  json["volume_mm3"] = s.volume_mm3;
  return json;
}

}  // namespace scantet
