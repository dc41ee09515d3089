// The tets inside of a level are a mesh of it.
#include <algorithm>

#include "scantet/verify/findings.h"
#include "scantet/verify/verify.h"

namespace scantet {

std::vector<Certificate> verify_levels(const TetMesh& mesh, const Scan& scan, const std::vector<double>& levels,
                                       const VerifyOptions& options, Progress& progress) {
  const bool is_sound = !mesh.tets.empty() && mesh.tet_regions.size() == mesh.tets.size();
  if (levels.size() == 1 || !is_sound) {  // what is not sound is refused there
    VerifyOptions of_level = options;
    of_level.level.level = levels.front();
    return {verify_mesh(mesh, scan, of_level, progress)};
  }
  std::vector<Region> regions = mesh.tet_regions;
  std::sort(regions.begin(), regions.end());
  regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
  std::vector<Certificate> certificates;
  for (std::size_t n = 0; n < levels.size(); ++n) {
    VerifyOptions of_level = options;
    of_level.level.level = levels[n];
    if (regions.size() != levels.size()) {
      certificates.push_back(verify_mesh(mesh, scan, of_level, progress));
      Certificate& c = certificates.back();
      verify::FindingList(c.findings)
          .add("mesh.regions", "the mesh has " + std::to_string(regions.size()) + " regions, not one a level",
               mesh.vertices[mesh.tets[0][0]]);
      c.grade = CertificateGrade::not_the_scan;
      continue;
    }
    TetMesh inside;
    inside.vertices = mesh.vertices;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      if (mesh.tet_regions[t] >= regions[n]) inside.tets.push_back(mesh.tets[t]);
    }
    inside.tet_regions.assign(inside.tets.size(), 1);
    certificates.push_back(verify_mesh(inside, scan, of_level, progress));
  }
  return certificates;
}

}  // namespace scantet
