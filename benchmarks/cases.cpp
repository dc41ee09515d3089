#include "cases.h"

#include <algorithm>
#include <filesystem>

#include "inputs.h"
#include "results.h"
#include "scantet/base/options.h"
#include "scantet/reading/scan_reader.h"
#include "tanglecube.h"

namespace scantet::bench {
namespace {

Case level_set(const char* name, const std::string& scan, double level, double size_mm, int runs) {
  Case c;
  c.name = name;
  c.scan = scan;
  c.level = {level, InsideSide::above, 0.0};
  c.size_mm = size_mm;
  c.runs = runs;
  return c;
}

// The paper's Figure 6 is the first: the image, level and size are its own.
Case skull(const std::string& volumes, const char* name, double size_mm, int runs) {
  return level_set(name, volumes + "/skull.nrrd", 2.9, size_mm, runs);
}

// Scans of Debian's package mricron-data that nobody smoothed. ch2bet: a human brain, 181 × 217 × 181 voxels of 1 mm.
Case rough(const char* name, const std::string& file, double level, double size_mm, int runs) {
  return level_set(name, "/usr/share/mricron/templates/" + file, level, size_mm, runs);
}

/// A CT of a head that nobody smoothed, bone.
Case head_ct(const char* name, double level, double size_mm, int runs) {
  return level_set(name, kHeadCtArchive, level, size_mm, runs);
}

Case brain(int runs) {
  Case c = rough("brain", "ch2bet.nii.gz", 20, 4, runs);
  c.options.bounds.alpha = 0.5;
  return c;
}

// The whole way to a mesh without tets under an angle.
Case improved_skull(const std::string& volumes, const char* name, double min_dihedral_deg, int runs) {
  Case c = skull(volumes, name, 2, runs);
  c.optimize = Optimize::full;
  c.min_dihedral_deg = min_dihedral_deg;
  c.contestants = {kScantetN, kScantet1, kCgalN};
  return c;
}

/// Segmentations of mricron-data, at twice the size of a voxel. spacing_mm: of the voxels.
Case labels(const char* name, const std::string& file, double spacing_mm, int runs) {
  Case c;
  c.name = std::string("labels_") + name;
  c.scan = "/usr/share/mricron/templates/" + file;
  c.labels = true;
  c.size_mm = 2 * spacing_mm;
  c.runs = runs;
  return c;
}

Case improved_labels(Case c, double min_dihedral_deg) {
  c.name += "_" + number_text(min_dihedral_deg) + "deg";
  c.optimize = Optimize::full;
  c.min_dihedral_deg = min_dihedral_deg;
  return c;
}

// Sizes at which the meshes have 100,000 to 500,000 tets.
Case implicit(const char* formula, double size_mm, int runs) {
  Case c;
  c.name = std::string("implicit_") + formula;
  c.formula = formula;
  c.size_mm = size_mm;
  c.runs = runs;
  return c;
}

Case polyhedron(const char* name, const char* surface, double size_mm, int runs) {
  Case c;
  c.name = std::string("polyhedron_") + name;
  c.surface = surface;
  c.size_mm = size_mm;
  c.runs = runs;
  return c;
}

/// With its sharp edges.
Case sharp_polyhedron(const char* name, const char* surface, double size_mm, int runs) {
  Case c = polyhedron(name, surface, size_mm, runs);
  c.name = std::string("sharp_") + name;
  c.sharp_deg = 30;
  return c;
}

void add_rough(int runs, int few_runs, std::vector<Case>& cases) {
  cases.push_back(rough("rough_ch2bet20_2mm", "ch2bet.nii.gz", 20, 2, runs));
  cases.push_back(rough("rough_ch2bet20_3mm", "ch2bet.nii.gz", 20, 3, runs));
  cases.push_back(rough("rough_ch2bet20_4mm", "ch2bet.nii.gz", 20, 4, runs));
  cases.push_back(rough("rough_ch2bet60_2mm", "ch2bet.nii.gz", 60, 2, runs));
  cases.push_back(rough("rough_ch2bet60_3mm", "ch2bet.nii.gz", 60, 3, runs));
  cases.push_back(rough("rough_ch2bet60_4mm", "ch2bet.nii.gz", 60, 4, runs));
  cases.push_back(rough("rough_inia19_1mm", "inia19-t1-brain.nii.gz", 100, 1, runs));
  cases.push_back(rough("rough_inia19_2mm", "inia19-t1-brain.nii.gz", 100, 2, runs));
  cases.push_back(rough("rough_ch2better_1mm", "ch2better.nii.gz", 60, 1, few_runs));
  cases.push_back(rough("rough_ch2better_2mm", "ch2better.nii.gz", 60, 2, runs));
  cases.push_back(head_ct("rough_head_ct226_1mm", 226, 1, few_runs));
  cases.push_back(head_ct("rough_head_ct226_2mm", 226, 2, runs));
  cases.push_back(head_ct("rough_head_ct226_4mm", 226, 4, runs));
}

}  // namespace

bool Case::has(const std::string& contestant) const {
  return contestants.empty() || std::find(contestants.begin(), contestants.end(), contestant) != contestants.end();
}

std::string Case::object() const {
  if (!scan.empty()) return scan;
  if (!formula.empty()) return "implicit:" + formula;
  return surface.empty() ? "tanglecube" : surface;
}

bool Case::available(std::string& why) const {
  if (!scan.empty() && !std::filesystem::exists(scan)) why = "there is no " + scan;
  if (!surface.empty() && !has_cgal_data()) why = "Debian's package libcgal-demo is not installed";
  return why.empty();
}

std::string Case::criteria() const {
  std::string text = "σ = " + (size_mm > 0 ? number_text(size_mm) + " mm" : std::string("graded")) +
                     ", α = " + number_text(options.bounds.alpha);
  if (optimize == Optimize::full) text += ", dihedral angles ≥ " + number_text(min_dihedral_deg) + "°";
  if (sharp_deg > 0) text += ", edges from " + number_text(sharp_deg) + "° on followed";
  if (optimize == Optimize::exude) text += ", exudation alone";
  return text;
}

std::vector<Case> all_cases(const std::string& volumes) {
  constexpr int kRuns = 5;
  constexpr int kFewRuns = 3;
  std::vector<Case> cases{skull(volumes, "skull", 2, kRuns), skull(volumes, "skull_1mm", 1, kFewRuns),
                          skull(volumes, "skull_0.5mm", 0.5, 1), brain(kRuns)};
  cases[2].contestants = {kScantetN, kScantet1};  // CGAL's parallel mesher would need about 29 GB
  Case graded;
  graded.name = "tanglecube";
  graded.runs = kRuns;
  cases.push_back(graded);
  cases.push_back(improved_skull(volumes, "skull_10deg", 10, kRuns));
  cases.push_back(improved_skull(volumes, "skull_20deg", 20, kRuns));
  Case exuded = skull(volumes, "skull_exude", 2, 1);
  exuded.optimize = Optimize::exude;
  exuded.min_dihedral_deg = 10;
  exuded.optimizing_alone = true;
  exuded.contestants = {kScantet1, kCgal1};
  cases.push_back(exuded);
  add_rough(kRuns, kFewRuns, cases);
  for (const Case& c : {labels("aal", "aal.nii.gz", 1, kRuns), labels("aicha", "AICHAmc.nii.gz", 2, kRuns),
                        labels("harvard_oxford", "HarvardOxford-cort-maxprob-thr0-1mm.nii.gz", 1, kRuns),
                        labels("natbrainlab", "natbrainlab.nii.gz", 1, kRuns)}) {
    cases.push_back(c);
    cases.push_back(improved_labels(c, 10));
  }
  Case cells;
  cells.name = "labels_voronoi";
  cells.scan = SCANTET_SAMPLE_VOLUMES "/labels_voronoi.nrrd";
  cells.labels = true;
  cells.size_mm = 2;
  cells.runs = kRuns;
  cases.push_back(cells);
  cases.push_back(implicit("torus", 0.03, kRuns));
  cases.push_back(implicit("tanglecube", 0.08, kRuns));
  cases.push_back(implicit("gyroid", 0.13, kRuns));
  cases.push_back(polyhedron("elephant", "meshes/elephant.off", 0.01, kRuns));
  cases.push_back(polyhedron("anchor", "meshes/anchor_dense.off", 0.01, kRuns));
  cases.push_back(polyhedron("armadillo", "meshes/armadillo.off", 1.2, kRuns));
  for (const Case& c : {sharp_polyhedron("cube", "meshes/cube.off", 0.05, kRuns),
                        sharp_polyhedron("fandisk", "meshes/fandisk.off", 0.015, kRuns),
                        sharp_polyhedron("anchor", "meshes/anchor.off", 0.015, kRuns)}) {
    cases.push_back(c);
    Case improved = c;
    improved.name += "_10deg";
    improved.optimize = Optimize::full;
    improved.min_dihedral_deg = 10;
    cases.push_back(improved);
  }
  return cases;
}

std::string plugin_input(const Case& c) {
  if (c.labels) return c.scan;
  return c.formula.empty() ? cgal_data_file(c.surface) : "implicit:" + c.formula;
}

Scan open_scan(const Case& c) {
  Progress progress;
  return read_scan(c.scan == kHeadCtArchive ? head_ct_file() : c.scan, progress);
}

std::unique_ptr<SizingField> sizing(const Case& c) {
  if (c.size_mm > 0) return std::make_unique<UniformSize>(c.size_mm);
  return std::make_unique<GradedSize>();
}

}  // namespace scantet::bench
