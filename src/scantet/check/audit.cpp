// The order of the checks. Those of the arrays come first: if ids point nowhere, nothing after them makes sense.
#include "scantet/check/audit.h"

#include "scantet/base/error.h"
#include "scantet/check/audit_impl.h"

namespace scantet {

AuditReport audit(const TetMesh& mesh, const Domain* domain, const AuditOptions& options) {
  constexpr std::size_t kMaxTets = std::size_t{1} << 27;  // six numbers for each face of each tet fit in 32 bits
  if (mesh.tets.size() >= kMaxTets) {
    throw Error(Fault::input, "input.too_large",
                "the mesh has " + std::to_string(mesh.tets.size()) + " tets, the audit takes 2^27 - 1 at most",
                "split the mesh");
  }
  AuditReport report;
  if (!auditing::check_arrays(mesh, report)) return report;
  report.complete = true;
  const auto used_vertices = static_cast<std::int64_t>(auditing::check_elements(mesh, report));
  auditing::FaceMatch match = auditing::match_faces(mesh, report);
  auditing::check_facets(mesh, match, report);
  const std::vector<std::uint32_t> component_of = auditing::list_components(mesh, match, report);
  auditing::check_boundary(mesh, match, component_of, report);
  auditing::list_interfaces(mesh, match, report);

  std::int64_t tets = 0;
  for (const MeshComponent& component : report.components) tets += static_cast<std::int64_t>(component.tets);
  report.mesh_euler =
      used_vertices - static_cast<std::int64_t>(match.edges) + static_cast<std::int64_t>(match.faces) - tets;

  if (domain != nullptr) auditing::check_domain(mesh, match, component_of, *domain, options, report);
  return report;
}

}  // namespace scantet
