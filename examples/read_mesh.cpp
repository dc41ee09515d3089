// A mesh read back:   read_mesh MESH [again]
// Without `again` it first writes a mesh of a ball to the file. Then it reads the file, measures the mesh, and asks the
// audit whether it is sound.
#include <scantet/scantet.h>

#include <iostream>

namespace {

void write_ball(const char* file) {
  scantet::Progress progress;
  const auto ball = scantet::make_sphere({0, 0, 0}, 10);
  scantet::MeshResult result = scantet::mesh_domain(*ball, scantet::UniformSize(2), {}, progress);
  scantet::optimize_mesh(result.mesh, *ball, {}, progress);
  scantet::write_mesh(result.mesh, file);
}

}  // namespace

int main(int count, char** words) {
  if (count < 2) {
    std::cerr << "usage: read_mesh MESH [again]\n";
    return 2;
  }
  try {
    if (count == 2) write_ball(words[1]);
    scantet::TetMesh mesh = scantet::read_mesh(words[1]);
    if (!mesh.tet_edge_vertices.empty()) mesh = scantet::first_order(mesh);  // which can be measured
    const scantet::QualitySummary quality = scantet::measure_quality(mesh);
    std::cout << mesh.vertices.size() << " vertices, " << mesh.tets.size() << " tets, " << quality.total_volume_mm3
              << " mm^3\ndihedral angles from " << quality.min_dihedral_deg() << " to " << quality.max_dihedral_deg()
              << " degrees\n";
    for (const scantet::WorstTet& worst : quality.smallest_dihedral) {
      std::cout << "  tet " << worst.tet << ": " << worst.value << " degrees\n";
    }
    scantet::AuditOptions how;
    how.restricted_delaunay = false;  // nothing is known of how it was made
    const scantet::AuditReport found = scantet::audit(mesh, nullptr, how);
    for (const scantet::Finding& finding : found.findings) std::cout << "wrong: " << finding.message << '\n';
    return found.passed() ? 0 : 1;
  } catch (const scantet::Error& error) {
    std::cerr << error.code() << ": " << error.what() << '\n';
    return static_cast<int>(error.fault());
  }
}
