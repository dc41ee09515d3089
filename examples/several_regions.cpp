// Several regions in one mesh:   several_regions MESH
// A scan is cut at two levels. Between them is region 1, within the higher one region 2, and the surface between the
// two is one set of triangles that the tets of both sides share.
#include <scantet/scantet.h>

#include <cmath>
#include <iostream>
#include <vector>

namespace {

// Values fall from 1000 in the middle to 0 and below: as bone within soft tissue.
scantet::Scan made_scan() {
  constexpr int kSide = 32;
  constexpr double kMiddle = 15.5;
  std::vector<short> values;
  for (int k = 0; k < kSide; ++k) {
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) {
        const double r = std::hypot(i - kMiddle, 1.3 * (j - kMiddle), k - kMiddle);
        values.push_back(static_cast<short>(1000 - 70 * r));
      }
    }
  }
  return scantet::make_scan(std::move(values), {kSide, kSide, kSide}, scantet::Frame());  // voxels of 1 mm
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) {
    std::cerr << "usage: several_regions MESH\n";
    return 2;
  }
  try {
    scantet::Progress progress;
    scantet::ScanMeshOptions options;
    options.levels = {100, 500};
    options.sizes.size = "3";                // mm
    options.sizes.region_sizes = {"2=1.5"};  // finer in region 2
    const scantet::MeshOutcome outcome = scantet::mesh_scan(made_scan(), options, progress);
    for (const scantet::RegionVolume& region : outcome.report.quality->regions) {
      std::cout << "region " << region.region << ": " << region.tets << " tets, " << region.volume_mm3 << " mm^3\n";
    }
    for (const scantet::MeshInterface& between : outcome.report.audit->interfaces) {
      std::cout << "between " << between.regions[0] << " and " << between.regions[1] << ": " << between.facets
                << " triangles\n";
    }
    scantet::write_mesh(outcome.mesh, words[1]);
    return outcome.findings.empty() && outcome.report.quality->regions.size() == 2 ? 0 : 1;
  } catch (const scantet::Error& error) {
    std::cerr << error.code() << ": " << error.what() << '\n';
    return static_cast<int>(error.fault());
  }
}
