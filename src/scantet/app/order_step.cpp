// What the library calls counts is said in words here.
#include "scantet/app/order_step.h"

#include "scantet/base/error.h"
#include "scantet/second_order/second_order.h"

namespace scantet {

void check_order(const MeshJob& job) {
  if (job.order == ElementOrder::first) return;
  if (job.certify != Certify::no) {
    throw Error(Fault::usage, "usage.order", "--order 2: --certify verifies meshes of straight tetrahedra",
                "leave out one of the two");
  }
}

std::string unproved_text(std::uint64_t tets) {
  return std::to_string(tets) + " tetrahedra of second order have a Jacobian that is not proved positive";
}

bool make_order_two(TetMesh& mesh, const Domain& domain, JobResult& result, const Progress& progress) {
  const SecondOrderCounts counts = make_second_order(mesh, domain, progress);
  if (mesh.tet_edge_vertices.empty()) return false;
  result.report.second_order = {counts.edges,      counts.boundary_edges, counts.on_boundary, counts.eased_edges,
                                counts.eased_tets, counts.unproved,       counts.least_share, counts.volume_mm3};
  std::string note = "second order: " + std::to_string(counts.edges) + " nodes on edges, " +
                     std::to_string(counts.on_boundary) + " of them on the surface";
  if (counts.off_boundary > 0) {
    note += ", " + std::to_string(counts.off_boundary) +
            " boundary edges straight, as the surface is not near their middle";
  }
  if (counts.eased_tets > 0) {
    note += "; " + std::to_string(counts.eased_edges) + " edges were taken back for the sake of " +
            std::to_string(counts.eased_tets) + " tetrahedra that would have turned over or nearly so";
  }
  result.notes.push_back(note);
  if (counts.unproved > 0) {
    result.findings.push_back(unproved_text(counts.unproved));
  }
  return true;
}

}  // namespace scantet
