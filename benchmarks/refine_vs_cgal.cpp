// Refinement alone, one thread: scantet's reference engine against CGAL's sequential Mesh_3, alternating, in one run.
//
//   refine_vs_cgal SCAN LEVEL SIZE_MM [RUNS] [OUTSIDE]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

#include "cgal_peer.h"
#include "scantet/image/scan_reader.h"

namespace {

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

void compare(const std::string& path, const scantet::LevelSetSettings& settings, double size_mm, int runs) {
  scantet::Progress progress;
  const scantet::Scan scan = scantet::read_scan(path, progress);
  const auto domain = scantet::make_level_set(scan, settings);
  const scantet::MesherOptions options;
  std::vector<double> ours;
  std::vector<double> theirs;
  std::vector<double> ratios;
  std::printf("run  scantet_s (sample + refine)  vertices  tets    cgal_s  vertices  tets    cgal/scantet\n");
  for (int run = 0; run < runs; ++run) {
    const auto mesh = scantet::mesh_domain(*domain, scantet::UniformSize(size_mm), options, progress);
    const auto peer = scantet::bench::run_cgal_mesh3(scan, settings, size_mm, options);
    ours.push_back(mesh.sample_s + mesh.refine_s);
    theirs.push_back(peer.refine_s);
    ratios.push_back(theirs.back() / ours.back());
    std::printf("%3d  %.3f (%.3f + %.3f)  %zu  %zu    %.3f  %zu  %zu    %.2f\n", run + 1, ours.back(), mesh.sample_s,
                mesh.refine_s, mesh.mesh.vertices.size(), mesh.mesh.tets.size(), peer.refine_s, peer.vertices,
                peer.tets, ratios.back());
  }
  std::printf("median  scantet %.3f s  cgal %.3f s  ratio %.2f  (worst ratio %.2f)\n", median(ours), median(theirs),
              median(ratios), *std::min_element(ratios.begin(), ratios.end()));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: refine_vs_cgal SCAN LEVEL SIZE_MM [RUNS] [OUTSIDE]\n");
    return 2;
  }
  try {
    scantet::LevelSetSettings settings{std::atof(argv[2]), scantet::InsideSide::above, std::nullopt};
    if (argc > 5) settings.outside = std::atof(argv[5]);
    compare(argv[1], settings, std::atof(argv[3]), argc > 4 ? std::max(1, std::atoi(argv[4])) : 3);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "refine_vs_cgal: %s\n", error.what());
    return 1;
  }
  return 0;
}
