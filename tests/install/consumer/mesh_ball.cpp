// Meshes a ball with the installed library, writes the mesh, and checks it: ends with status 1 if anything is wrong.
#include <cmath>
#include <fstream>
#include <iostream>
#include <string>

#include "scantet/base/error.h"
#include "scantet/base/version.h"
#include "scantet/domain/analytic.h"
#include "scantet/domain/sizing_field.h"
#include "scantet/io/mesh_io.h"
#include "scantet/refine/mesher.h"

namespace {

constexpr double kRadius = 10;
constexpr double kSize = 2;

double volume_mm3(const scantet::TetMesh& mesh) {
  double six_volumes = 0;
  for (const scantet::Tet& tet : mesh.tets) {
    six_volumes += scantet::orientation_mm3(mesh.vertices[tet[0]], mesh.vertices[tet[1]], mesh.vertices[tet[2]],
                                            mesh.vertices[tet[3]]);
  }
  return six_volumes / 6;
}

bool expect(bool holds, const std::string& what) {
  if (!holds) std::cerr << "wrong: " << what << '\n';
  return holds;
}

// The polyhedron is inscribed in the ball: smaller, by no more than a cap's height allows.
bool is_right(const scantet::MeshResult& result, const std::string& path) {
  const double ball = 4.0 / 3.0 * std::acos(-1.0) * kRadius * kRadius * kRadius;
  const double volume = volume_mm3(result.mesh);
  const std::ifstream file(path);
  bool right = expect(result.stop == scantet::Stop::converged, "the mesher did not converge");
  right = expect(result.counts.unmet.total() == 0, "a rule is unmet") && right;
  right = expect(volume < ball && volume > 0.93 * ball, "volume " + std::to_string(volume) + " mm³") && right;
  right = expect(file.good(), path + " was not written") && right;
  for (std::size_t v = 0; v < result.mesh.vertices.size(); ++v) {
    if (!result.mesh.on_boundary(v)) continue;
    right = expect(std::abs(scantet::length(result.mesh.vertices[v]) - kRadius) < 1e-6, "a vertex is off the ball") &&
            right;
  }
  return right;
}

// What the library throws is what this program catches, though this program hides its symbols: one type, one code.
bool errors_arrive() {
  scantet::Progress progress;
  const auto ball = scantet::make_sphere({0, 0, 0}, kRadius);
  scantet::MesherOptions options;
  options.bounds.alpha = -1;
  try {
    scantet::mesh_domain(*ball, scantet::UniformSize(kSize), options, progress);
  } catch (const scantet::Error& error) {
    return expect(error.code() == "usage.option", "the code of an error: " + error.code());
  } catch (const std::exception&) {
    return expect(false, "an error arrives as an exception of another type");
  }
  return expect(false, "alpha of -1 is no error");
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) {
    std::cerr << "usage: mesh_ball FILE.vtu\n";
    return 2;
  }
  const std::string path = words[1];
  try {
    scantet::Progress progress;
    const auto ball = scantet::make_sphere({0, 0, 0}, kRadius);
    const auto result = scantet::mesh_domain(*ball, scantet::UniformSize(kSize), {}, progress);
    scantet::write_mesh(result.mesh, path);
    std::cout << "scantet " << scantet::kVersion << ": " << result.mesh.vertices.size() << " vertices, "
              << result.mesh.tets.size() << " tets in " << path << '\n';
    return is_right(result, path) && errors_arrive() ? 0 : 1;
  } catch (const scantet::Error& error) {
    std::cerr << error.code() << ": " << error.what() << '\n';
    return 1;
  }
}
