#include "scantet/check/losses.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "scantet/check/audit_impl.h"

namespace scantet {
namespace {

constexpr std::array<std::string_view, 8> kLosses{
    "audit.curve",        "audit.boundary_edge", "audit.boundary_vertex", "audit.lost_label",
    "audit.joined_label", "audit.split_label",   "audit.cavity_missing",  "audit.cavity_joined"};

}  // namespace

std::vector<Point> find_losses(const TetMesh& mesh, const Domain& domain, const RegionGrid& grid,
                               const SizingField& size) {
  AuditReport report;
  if (!auditing::check_arrays(mesh, report)) return {};
  const bool all_positive = auditing::check_elements(mesh, report).all_positive;
  auditing::FaceMatch match = auditing::match_faces(mesh, TetStars(mesh), all_positive, report);
  const std::vector<std::uint32_t> component_of = auditing::list_components(mesh, match, report);
  const auditing::OutsideSurfaces outside = auditing::check_boundary(mesh, match, component_of, report);
  auditing::check_regions(mesh, match, component_of, outside, grid, report);
  auditing::check_curves(mesh, match, auditing::boundary_vertices(mesh, match), domain, &size, report);
  std::vector<Point> places;
  for (const Finding& finding : report.findings) {
    if (std::find(kLosses.begin(), kLosses.end(), finding.code) == kLosses.end()) continue;
    places.insert(places.end(), finding.places.begin(), finding.places.end());
  }
  return places;
}

}  // namespace scantet
