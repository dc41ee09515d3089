// One pass over the tets, on several threads.
#include "scantet/quality/quality_fields.h"

#include <algorithm>
#include <array>
#include <string>

#include "scantet/base/parallel.h"
#include "scantet/quality/measures.h"

namespace scantet {
namespace {

constexpr std::size_t kStretch = 8192;  // tets that one thread takes at once
constexpr std::array<std::string_view, 9> kNames{"min_dihedral_deg", "max_dihedral_deg", "radius_edge",
                                                 "inverse_aspect",   "scaled_jacobian",  "stiffness_ratio",
                                                 "min_height_mm",    "circumradius_mm",  "volume_mm3"};

/// In the order of kNames.
std::array<double, kNames.size()> values_of(const TetMesh& mesh, const Tet& tet) {
  const auto& p = mesh.vertices;
  const TetMeasures m = measure_tet(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]);
  const auto [least, most] = std::minmax_element(m.dihedral_deg.begin(), m.dihedral_deg.end());
  return {*least,
          *most,
          m.radius_edge,
          m.inverse_aspect,
          m.scaled_jacobian,
          stiffness_ratio(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]),
          m.min_height_mm,
          m.circumradius_mm,
          m.volume_mm3};
}

}  // namespace

std::span<const std::string_view> quality_field_names() {
  return kNames;
}

std::vector<MeshField> quality_fields(const TetMesh& mesh) {
  std::vector<MeshField> fields;
  fields.reserve(kNames.size());
  for (const std::string_view name : kNames) {
    fields.push_back({std::string(name), std::vector<double>(mesh.tets.size())});
  }
  parallel_for(mesh.tets.size(), kStretch, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const auto values = values_of(mesh, mesh.tets[t]);
      for (std::size_t i = 0; i < values.size(); ++i) fields[i].values[t] = values[i];
    }
  });
  return fields;
}

}  // namespace scantet
