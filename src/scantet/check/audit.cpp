// The order of the checks. Those of the arrays come first: if ids point nowhere, nothing after them makes sense.
#include "scantet/check/audit.h"

#include "scantet/base/error.h"
#include "scantet/base/phase_clock.h"
#include "scantet/check/audit_impl.h"

namespace scantet {
namespace {

// What the checks take beside each other, for the progress.
constexpr std::uint64_t kArrays = 2;
constexpr std::uint64_t kElements = 10;
constexpr std::uint64_t kFaces = 40;
constexpr std::uint64_t kFacets = 5;
constexpr std::uint64_t kComponents = 5;
constexpr std::uint64_t kBoundary = 10;
constexpr std::uint64_t kCrossings = 10;
constexpr std::uint64_t kResiduals = 3;
constexpr std::uint64_t kCircumcentres = 15;
constexpr std::uint64_t kLedgers = 10;
constexpr std::uint64_t kRegions = 5;
constexpr std::uint64_t kWithoutDomain = kArrays + kElements + kFaces + kFacets + kComponents + kBoundary + kCrossings;
constexpr std::uint64_t kWithDomain = kWithoutDomain + kResiduals + kCircumcentres + kLedgers;

}  // namespace

AuditReport audit(const TetMesh& mesh, const Domain* domain, const AuditOptions& options) {
  constexpr std::size_t kMaxTets = std::size_t{1} << 27;  // six numbers for each face of each tet fit in 32 bits
  if (mesh.tets.size() >= kMaxTets) {
    throw Error(Fault::input, "input.too_large",
                "the mesh has " + std::to_string(mesh.tets.size()) + " tets, the audit takes 2^27 - 1 at most",
                "split the mesh");
  }
  AuditReport report;
  Progress nobody;
  PhaseClock phases(report.phases, options.progress == nullptr ? nobody : *options.progress);
  phases.expect((domain == nullptr ? kWithoutDomain : kWithDomain) + (options.grid == nullptr ? 0 : kRegions));
  phases.begin("audit", "arrays", kArrays);
  if (!auditing::check_arrays(mesh, report)) return report;
  report.complete = true;
  phases.begin("audit", "elements", kElements);
  const auto [used_vertices, all_positive] = auditing::check_elements(mesh, report);
  phases.begin("audit", "faces", kFaces);
  auditing::FaceMatch match = options.stars == nullptr
                                  ? auditing::match_faces(mesh, TetStars(mesh), all_positive, report)
                                  : auditing::match_faces(mesh, *options.stars, all_positive, report);
  phases.begin("audit", "facets", kFacets);
  auditing::check_facets(mesh, match, report);
  phases.begin("audit", "components", kComponents);
  const std::vector<std::uint32_t> component_of = auditing::list_components(mesh, match, report);
  auditing::measure_components(mesh, component_of, report);
  phases.begin("audit", "boundary", kBoundary);
  const auditing::OutsideSurfaces outside = auditing::check_boundary(mesh, match, component_of, report);
  auditing::list_interfaces(mesh, match, report);
  phases.begin("audit", "crossings", kCrossings);
  auditing::check_crossings(mesh, report);

  const auto number = [](std::uint64_t count) { return static_cast<std::int64_t>(count); };
  std::int64_t tets = 0;
  for (const MeshComponent& component : report.components) tets += number(component.tets);
  report.mesh_euler = number(used_vertices) - number(match.edges) + number(match.faces) - tets;

  if (options.grid != nullptr) {
    phases.begin("audit", "voxels", kRegions);
    auditing::check_regions(mesh, match, component_of, outside, *options.grid, report);
  }
  if (domain == nullptr) return report;
  phases.begin("audit", "distance from the domain", kResiduals);
  const std::vector<VertexId> boundary = auditing::boundary_vertices(mesh, match);
  auditing::check_residuals(mesh, boundary, *domain, options.max_residual, report);
  phases.begin("audit", "circumcentres", kCircumcentres);
  auditing::check_circumcentres(mesh, *domain, options.restricted_delaunay, report);
  phases.begin("audit", "components of the domain", kLedgers);
  auditing::check_curves(mesh, match, boundary, *domain, options.size, report);
  auditing::check_ledgers(mesh, match, boundary, component_of, outside, *domain, report);
  if (options.distance != nullptr && options.size != nullptr) {
    auditing::check_distance(mesh, *domain, *options.distance, *options.size, report);
  }
  return report;
}

}  // namespace scantet
