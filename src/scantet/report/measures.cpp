// The keys are a contract (report.h): add, never rename.
#include "scantet/report/measures_impl.h"

namespace scantet {

std::span<const ReportMeasure> report_measures() {
  using Q = QualitySummary;
  static const ReportMeasure measures[] = {
      {"inverse_aspect", [](const Q& q) { return &q.inverse_aspect; },
       MeasureAxis{"Inverse aspect ratio", "inradius / circumradius", "", "density", 0, 1.0 / 3, false, 0.05}},
      {"dihedral_deg", [](const Q& q) { return &q.dihedral_deg; },
       MeasureAxis{"Dihedral angles", "angle, °", "°", "density, 1/°", 0, 180, false, 30}},
      {"radius_edge", [](const Q& q) { return &q.radius_edge; },
       MeasureAxis{"Radius-edge ratio", "circumradius / shortest edge", "", "density", 0.6, std::nullopt, true, 0}},
      {"edge_length_mm", [](const Q& q) { return &q.edge_length_mm; },
       MeasureAxis{"Edge lengths", "length, mm", " mm", "density, 1/mm", 0, std::nullopt, false, 0}},
      {"circumradius_mm", [](const Q& q) { return &q.circumradius_mm; }, std::nullopt},
      {"volume_mm3", [](const Q& q) { return &q.volume_mm3; }, std::nullopt},
      {"size_ratio", [](const Q& q) { return q.size_ratio ? &*q.size_ratio : nullptr; },
       MeasureAxis{"Sizes against the sizing field", "circumradius / size asked for there", "", "density", 0,
                   std::nullopt, true, 0}},
  };
  return measures;
}

}  // namespace scantet
