// The keys are a contract (report.h): add, never rename.
#include "scantet/report/measures_impl.h"
#include "scantet/report/named_distributions.h"

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
      {"scaled_jacobian", [](const Q& q) { return &q.scaled_jacobian; },
       MeasureAxis{"Scaled Jacobians", "scaled Jacobian", "", "density", 0, 1, false, 0.2}},
      {"largest_dihedral_deg", [](const Q& q) { return &q.largest_dihedral_deg; },
       MeasureAxis{"Largest dihedral angle of each tet", "angle, °", "°", "density, 1/°", 60, 180, false, 30}},
      {"min_height_mm", [](const Q& q) { return &q.min_height_mm; },
       MeasureAxis{"Least heights", "height, mm", " mm", "density, 1/mm", 0, std::nullopt, false, 0}},
      {"stable_time_step_us", [](const Q& q) { return &q.stable_time_step_us; },
       MeasureAxis{"Stable time steps", "least height / wave speed, µs", " µs", "density, 1/µs", 0, std::nullopt, false,
                   0}},
      {"stiffness_ratio", [](const Q& q) { return &q.stiffness_ratio; },
       MeasureAxis{"Stiffness by shape", "largest eigenvalue / that of the regular tet", "", "density", 1, std::nullopt,
                   true, 0}},
      {"circumradius_mm", [](const Q& q) { return &q.circumradius_mm; }, std::nullopt},
      {"volume_mm3", [](const Q& q) { return &q.volume_mm3; },
       MeasureAxis{"Volumes", "volume, mm³", " mm³", "density, 1/mm³", 0, std::nullopt, false, 0}},
      {"size_ratio", [](const Q& q) { return q.size_ratio ? &*q.size_ratio : nullptr; },
       MeasureAxis{"Sizes against the sizing field", "circumradius / size asked for there", "", "density", 0,
                   std::nullopt, true, 0}},
      {"edge_size_ratio", [](const Q& q) { return q.edge_size_ratio ? &*q.edge_size_ratio : nullptr; },
       MeasureAxis{"Edges against the sizing field", "length / size asked for there", "", "density", 0, std::nullopt,
                   true, 0}},
  };
  return measures;
}

std::span<const ReportWorst> report_worst_lists() {
  using Q = QualitySummary;
  static const ReportWorst lists[] = {
      {"min_dihedral_deg", "smallest dihedral angle", "°", &Q::smallest_dihedral},
      {"max_radius_edge", "largest radius-edge ratio", "", &Q::largest_radius_edge},
      {"min_edge_length_mm", "shortest edge", " mm", &Q::shortest_edge},
      {"min_height_mm", "least height", " mm", &Q::least_height},
      {"min_scaled_jacobian", "smallest scaled Jacobian", "", &Q::smallest_scaled_jacobian},
      {"max_dihedral_deg", "largest dihedral angle", "°", &Q::largest_dihedral},
      {"min_volume_mm3", "least volume", " mm³", &Q::least_volume},
      {"max_stiffness_ratio", "largest stiffness by shape", "", &Q::largest_stiffness_ratio},
      {"min_edge_size_ratio", "shortest edge / size there", "", &Q::least_edge_size_ratio},
  };
  return lists;
}

std::vector<NamedDistribution> named_distributions(const QualitySummary& quality) {
  std::vector<NamedDistribution> named;
  for (const ReportMeasure& measure : report_measures()) {
    const Distribution* const distribution = measure.distribution(quality);
    if (distribution != nullptr) named.push_back({measure.key, distribution});
  }
  return named;
}

}  // namespace scantet
