// From a scan to a checked mesh:   scan_to_mesh MESH [SCAN [LEVEL]]
// Without SCAN (a NRRD, NIfTI, MetaImage, DICOM or TIFF file) it meshes voxels that it makes itself.
#include <scantet/scantet.h>

#include <cmath>
#include <iostream>
#include <string>
#include <vector>

namespace {

// A ball with bumps, as 40 x 40 x 40 voxels of 0.5 mm. The scan keeps the values.
scantet::Scan made_scan() {
  constexpr int kSide = 40;
  constexpr double kMiddle = 19.5;
  std::vector<float> values;
  for (int k = 0; k < kSide; ++k) {
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) {
        const double r = std::hypot(i - kMiddle, j - kMiddle, k - kMiddle);
        const double bumps = std::sin(0.5 * i) * std::sin(0.5 * j) * std::sin(0.5 * k);
        values.push_back(static_cast<float>(100 * (15 + bumps - r)));
      }
    }
  }
  const scantet::Frame half_mm({scantet::Vec{0.5, 0, 0}, scantet::Vec{0, 0.5, 0}, scantet::Vec{0, 0, 0.5}}, {});
  return scantet::make_scan(std::move(values), {kSide, kSide, kSide}, half_mm);
}

}  // namespace

int main(int count, char** words) {
  if (count < 2) {
    std::cerr << "usage: scan_to_mesh MESH [SCAN [LEVEL]]\n";
    return 2;
  }
  try {
    scantet::Progress progress;  // derive from it to show how far it is, or to cancel
    const scantet::Scan scan = count > 2 ? scantet::read_scan(words[2], progress) : made_scan();
    scantet::ScanMeshOptions options;
    if (count > 3) options.levels = {std::stod(words[3])};
    const scantet::MeshOutcome outcome = scantet::mesh_scan(scan, options, progress);
    for (const std::string& note : outcome.notes) std::cout << "note: " << note << '\n';
    for (const std::string& finding : outcome.findings) std::cout << "not as asked for: " << finding << '\n';
    std::cout << scantet::text_report(outcome.report);
    scantet::write_mesh(outcome.mesh, words[1]);
    return outcome.findings.empty() ? 0 : 1;
  } catch (const scantet::Error& error) {
    std::cerr << error.code() << ": " << error.what() << '\n';
    return static_cast<int>(error.fault());
  }
}
