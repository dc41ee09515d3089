// Sizes that vary:   sizing MESH
// A sizing field says how large elements may be at each point. Here a torus is meshed with 1.5 mm everywhere; then
// finer around one place by a field of one's own; then as fine as the distance to the boundary says, by a formula.
#include <scantet/scantet.h>

#include <iostream>
#include <memory>
#include <vector>

namespace {

// The size grows with the distance from a point: by 0.3 mm each mm. It should not grow by more than 1 mm each mm.
class FinerAround final : public scantet::SizingField {
 public:
  FinerAround(const scantet::Point& place, double size_mm) : place_(place), size_mm_(size_mm) {}
  double size_at(const scantet::Point& p) const override { return size_mm_ + 0.3 * scantet::distance(p, place_); }
  double min_size() const override { return size_mm_; }

 private:
  scantet::Point place_;
  double size_mm_;
};

std::size_t tets_of(const scantet::Domain& domain, const std::shared_ptr<const scantet::SizingField>& size) {
  scantet::Progress progress;
  return scantet::mesh_domain(domain, *size, {}, progress).mesh.tets.size();
}

// A ball in 24 x 24 x 24 voxels of 1 mm.
scantet::Scan made_scan() {
  constexpr int kSide = 24;
  const scantet::Point middle{11.5, 11.5, 11.5};
  std::vector<float> values;
  for (int n = 0; n < kSide * kSide * kSide; ++n) {
    const scantet::Point p{double(n % kSide), double(n / kSide % kSide), double(n / kSide / kSide)};
    values.push_back(static_cast<float>(9 - scantet::distance(p, middle)));
  }
  return scantet::make_scan(std::move(values), {kSide, kSide, kSide}, scantet::Frame());
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) {
    std::cerr << "usage: sizing MESH\n";
    return 2;
  }
  try {
    const auto torus = scantet::make_torus({0, 0, 0}, 10, 4);
    const auto uniform = std::make_shared<scantet::UniformSize>(1.5);
    const auto around = std::make_shared<FinerAround>(scantet::Point{10, 0, 4}, 0.3);
    const auto least =
        std::make_shared<scantet::LeastSize>(std::vector<std::shared_ptr<const scantet::SizingField>>{uniform, around});
    const std::size_t coarse = tets_of(*torus, uniform);
    const std::size_t finer = tets_of(*torus, least);
    std::cout << "1.5 mm everywhere: " << coarse << " tets; finer around a place: " << finer << '\n';

    // Of a scan, all that docs/sizing.md describes is there as text: d is the distance to the boundary.
    scantet::Progress progress;
    scantet::ScanMeshOptions options;
    options.levels = {0};
    options.sizes.size = "0.8 + 0.4*d";
    const scantet::MeshOutcome outcome = scantet::mesh_scan(made_scan(), options, progress);
    std::cout << "a ball, finer near its boundary: " << outcome.mesh.tets.size() << " tets\n";
    scantet::write_mesh(outcome.mesh, words[1]);
    return finer > coarse && outcome.findings.empty() ? 0 : 1;
  } catch (const scantet::Error& error) {
    std::cerr << error.code() << ": " << error.what() << '\n';
    return static_cast<int>(error.fault());
  }
}
