#include "cases.h"

#include "scantet/base/options.h"
#include "scantet/image/scan_reader.h"
#include "tanglecube.h"

namespace scantet::bench {
namespace {

// The paper's Figure 6 is the first: the image, level and size are its own.
Case skull(const std::string& volumes, const char* name, double size_mm, int runs) {
  Case c;
  c.name = name;
  c.scan = volumes + "/skull.nrrd";
  c.level = {2.9, InsideSide::above, 0.0};
  c.size_mm = size_mm;
  c.runs = runs;
  return c;
}

// Debian's package mricron-data: a human brain, 181 × 217 × 181 voxels of 1 mm.
Case brain(int runs) {
  Case c;
  c.name = "brain";
  c.scan = "/usr/share/mricron/templates/ch2bet.nii.gz";
  c.level = {20, InsideSide::above, 0.0};
  c.size_mm = 4;
  c.options.alpha = 0.5;
  c.runs = runs;
  return c;
}

}  // namespace

std::string Case::criteria() const {
  return "σ = " + (size_mm > 0 ? number_text(size_mm) + " mm" : std::string("graded")) +
         ", α = " + number_text(options.alpha);
}

std::vector<Case> all_cases(const std::string& volumes) {
  constexpr int kRuns = 5;
  constexpr int kFewRuns = 3;
  std::vector<Case> cases{skull(volumes, "skull", 2, kRuns), skull(volumes, "skull_1mm", 1, kFewRuns),
                          skull(volumes, "skull_0.5mm", 0.5, 1), brain(kRuns)};
  cases[2].peers = false;  // CGAL's parallel mesher would need about 29 GB
  Case graded;
  graded.name = "tanglecube";
  graded.runs = kRuns;
  cases.push_back(graded);
  return cases;
}

Scan open_scan(const Case& c) {
  Progress progress;
  return read_scan(c.scan, progress);
}

std::unique_ptr<SizingField> sizing(const Case& c) {
  if (c.size_mm > 0) return std::make_unique<UniformSize>(c.size_mm);
  return std::make_unique<GradedSize>();
}

}  // namespace scantet::bench
