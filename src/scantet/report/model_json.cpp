// Keys as docs/fields.md and docs/second_order.md list them.
#include "scantet/report/report_json_impl.h"

namespace scantet {

nlohmann::ordered_json field_json(const ReportField& f) {
  return {{"name", f.name}, {"scan", f.scan}, {"measure", f.measure}, {"min", f.min},
          {"max", f.max},   {"mean", f.mean}, {"total", f.total},     {"tets_outside", f.tets_outside}};
}

nlohmann::ordered_json second_order_json(const ReportSecondOrder& s) {
  return {{"edges", s.edges},
          {"boundary_edges", s.boundary_edges},
          {"on_boundary", s.on_boundary},
          {"eased_edges", s.eased_edges},
          {"eased_tets", s.eased_tets},
          {"unproved", s.unproved},
          {"least_share", s.least_share},
          {"volume_mm3", s.volume_mm3}};
}

}  // namespace scantet
