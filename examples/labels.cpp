// A segmentation in memory, one call:   labels MESH
// The voxels are labels: 1 a ball, 2 a shell around it, 3 half of what is around that. Each becomes a region; where
// three of them meet the mesh has an edge. All voxel centres are looked for in the mesh's region of their label.
#include <scantet/scantet.h>

#include <cmath>
#include <iostream>
#include <vector>

namespace {

constexpr int kSide = 36;

std::vector<unsigned char> made_labels() {
  constexpr double kMiddle = 17.5;
  std::vector<unsigned char> labels;
  for (int k = 0; k < kSide; ++k) {
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) {
        const double r = std::hypot(i - kMiddle, j - kMiddle, k - kMiddle);
        labels.push_back(r < 8 ? 1 : r < 11 ? 2 : r < 15 && i > kMiddle ? 3 : 0);
      }
    }
  }
  return labels;
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) {
    std::cerr << "usage: labels MESH\n";
    return 2;
  }
  try {
    scantet::Progress progress;
    scantet::ScanMeshOptions options;
    scantet::LabelSettings labels;
    labels.smoothing = scantet::LabelSmoothing::keep;
    labels.names = {{1, "core"}, {2, "shell"}, {3, "half"}};
    options.labels = labels;
    options.sizes.layers = "2,shell";  // two tets across it at least
    const scantet::Scan scan = scantet::make_scan(made_labels(), {kSide, kSide, kSide}, scantet::Frame());
    const scantet::MeshOutcome outcome = scantet::mesh_scan(scan, options, progress);
    for (const scantet::ReportRegion& region : outcome.report.regions) {
      if (!region.grid) continue;
      std::cout << region.name << ": " << region.mesh.tets << " tets, " << region.mesh.volume_mm3 << " mm^3, "
                << region.grid->kept << " of " << region.grid->grid.nodes << " voxel centres in it\n";
    }
    for (const std::string& finding : outcome.findings) std::cout << finding << '\n';
    scantet::write_mesh(outcome.mesh, words[1]);
    // The domain by itself, for whoever wants to ask it: which label is where.
    const scantet::LabelObject object = scantet::make_label_object(scan, labels, progress);
    const bool is_core = object.domain->region_at({17.5, 17.5, 17.5}) == 1;
    return outcome.findings.empty() && outcome.report.regions.size() == 4 && is_core ? 0 : 1;
  } catch (const scantet::Error& error) {
    std::cerr << error.code() << ": " << error.what() << '\n';
    return static_cast<int>(error.fault());
  }
}
