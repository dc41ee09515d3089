#include "scantet/app/mesh_scan.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>

#include "error_code.h"
#include "scantet/app/built_in_plugins.h"
#include "scantet/app/job.h"
#include "scantet/base/error.h"
#include "scantet/field/scan_from_memory.h"
#include "scantet/io/mesh_io.h"
#include "scantet/reading/scan_reader.h"

namespace scantet {
namespace {

constexpr int kSide = 24;
constexpr double kSpacingMm = 0.5;

/// Heights over a ball of 8 voxels in the middle, and over one of 2 in a corner, in steps of 0.05 voxels.
std::vector<std::int16_t> heights() {
  std::vector<std::int16_t> values;
  for (int k = 0; k < kSide; ++k) {
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) {
        const Vec p{double(i), double(j), double(k)};
        const double large = 8 - distance(p, {11.5, 11.5, 11.5});
        const double small = 2 - distance(p, {3, 3, 3});
        values.push_back(static_cast<std::int16_t>(std::lround(20 * std::max(large, small))));
      }
    }
  }
  return values;
}

Scan two_balls() {
  const Frame frame({Vec{kSpacingMm, 0, 0}, Vec{0, kSpacingMm, 0}, Vec{0, 0, kSpacingMm}}, {-5, 10, 100});
  return make_scan(heights(), {kSide, kSide, kSide}, frame);
}

bool mentions(const std::vector<std::string>& texts, const std::string& what) {
  return std::any_of(texts.begin(), texts.end(),
                     [&](const std::string& text) { return text.find(what) != std::string::npos; });
}

std::string code_of(const Scan& scan, const ScanMeshOptions& options) {
  Progress progress;
  return test::error_code([&] { mesh_scan(scan, options, progress); });
}

TEST(MeshScan, MeshesAuditsAndReports) {
  ScanMeshOptions options;
  options.levels = {0};
  Progress progress;
  const MeshOutcome outcome = mesh_scan(two_balls(), options, progress);
  EXPECT_FALSE(outcome.cancelled);
  EXPECT_TRUE(outcome.findings.empty()) << outcome.findings.front();
  EXPECT_TRUE(mentions(outcome.notes, "no --size given: size 1 mm"));
  ASSERT_TRUE(outcome.report.audit && outcome.report.quality && outcome.report.timing_s);
  EXPECT_TRUE(outcome.report.audit->passed());
  EXPECT_EQ(outcome.report.audit->components.size(), 2U);
  EXPECT_GE(outcome.report.quality->min_dihedral_deg(), kMinDihedralDeg);
  EXPECT_LE(outcome.report.quality->max_dihedral_deg(), kMaxDihedralDeg);
  const double volume = 4.0 / 3.0 * std::acos(-1.0) * (8 * 8 * 8 + 2 * 2 * 2) * std::pow(kSpacingMm, 3);
  EXPECT_NEAR(outcome.report.quality->total_volume_mm3, volume, 0.1 * volume);  // inscribed, and coarse
  Box box;
  for (const Point& p : outcome.mesh.vertices) box.extend(p);
  EXPECT_GT(box.min.z, 100);  // where the scan is
}

TEST(MeshScan, IsTheMeshOfTheCommand) {
  const std::string folder = testing::TempDir() + std::to_string(getpid()) + "_scantet_mesh_scan";
  std::filesystem::create_directory(folder);
  const std::string file = folder + "/balls.nrrd";
  {
    const std::vector<std::int16_t> values = heights();
    std::ofstream out(file, std::ios::binary);
    out << "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 24 24 24\n"
        << "space directions: (0.5,0,0) (0,0.5,0) (0,0,0.5)\nspace origin: (-5,10,100)\nencoding: raw\n"
        << "endian: little\n\n";
    out.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(2 * values.size()));
  }
  MeshJob job;
  job.input = file;
  job.input_options = {{"level", "20", "--level"}, {"components", "largest", "--components"}};
  job.sizes.size = "0.5 + 0.2*d";
  job.outputs = {folder + "/job.mesh"};
  Progress progress;
  run_mesh_job(job, built_in_plugins(), progress);

  ScanMeshOptions options;
  options.levels = {20};
  options.largest_count = 1;
  options.sizes.size = "0.5 + 0.2*d";
  const MeshOutcome of_memory = mesh_scan(two_balls(), options, progress);
  const MeshOutcome of_file = mesh_scan(read_scan(file, progress), options, progress);
  const TetMesh written = read_mesh(folder + "/job.mesh");
  EXPECT_FALSE(written.tets.empty());
  for (const MeshOutcome* outcome : {&of_memory, &of_file}) {
    EXPECT_EQ(outcome->mesh.vertices, written.vertices);
    EXPECT_EQ(outcome->mesh.tets, written.tets);
    EXPECT_EQ(outcome->report.components->components.size(), 1U);
  }
  std::filesystem::remove_all(folder);
}

TEST(MeshScan, ChoosesALevelWhereNoneIsGiven) {
  ScanMeshOptions options;
  options.min_component_mm3 = 10;
  options.optimize = Optimize::none;
  Progress progress;
  const MeshOutcome outcome = mesh_scan(two_balls(), options, progress);
  EXPECT_TRUE(mentions(outcome.notes, "no level given: "));
  EXPECT_FALSE(outcome.mesh.tets.empty());
  EXPECT_FALSE(outcome.report.timing_s->optimize);
}

TEST(MeshScan, MakesTheScanSimplerFirst) {
  ScanMeshOptions options;
  options.levels = {0};
  options.optimize = Optimize::none;
  options.simplification.crop = read_crop("", "7:,7:,:", CropBox::Unit::voxels);
  options.simplification.smooth_mm = 0.5;
  options.simplification.smoothing = Smoothing::curvature;
  options.fill_cavities_mm3 = 1;
  Progress progress;
  const MeshOutcome outcome = mesh_scan(two_balls(), options, progress);
  EXPECT_TRUE(mentions(outcome.notes, "the image is the one after a cut (--crop-voxels 7:,7:,:), curvature flow"));
  EXPECT_TRUE(mentions(outcome.notes, "--fill-cavities 1: there is no cavity so small"));
  EXPECT_EQ(outcome.report.audit->components.size(), 1U) << "the other ball is cut away";
  options.simplification.crop->low[0] = 100;
  EXPECT_EQ(code_of(two_balls(), options), "usage.crop");
}

TEST(MeshScan, ClosesHandlesFirst) {
  std::vector<float> values;
  for (int n = 0; n < 13 * 13 * 7; ++n) {
    const double around = std::hypot(n % 13 - 6.1, n / 13 % 13 - 6.2) - 3.6;
    values.push_back(static_cast<float>(1.2 - std::hypot(around, n / 169 - 3.1)));
  }
  const Scan ring = make_scan(values, {13, 13, 7}, Frame());
  ScanMeshOptions options;
  options.levels = {0};
  options.optimize = Optimize::none;
  options.close_handles_mm = 4;
  Progress progress;
  const MeshOutcome outcome = mesh_scan(ring, options, progress);
  EXPECT_TRUE(mentions(outcome.notes, "--close-handles 4 leaves 0 of 1 handles: 1 cut and 0 fillings change"));
  EXPECT_EQ(outcome.report.audit->components.size(), 1U);
  options.levels = {0, 0.5};
  EXPECT_EQ(code_of(ring, options), "usage.close_handles");
  options.levels = {0};
  options.close_handles_mm = 14;
  EXPECT_EQ(code_of(ring, options), "usage.close_handles");
}

TEST(MeshScan, MeshesRegions) {
  ScanMeshOptions options;
  options.levels = {80, 0};
  options.sizes.region_sizes = {"2=0.6"};
  Progress progress;
  const MeshOutcome outcome = mesh_scan(two_balls(), options, progress);
  EXPECT_EQ(outcome.report.quality->regions.size(), 2U);
  EXPECT_EQ(*std::max_element(outcome.mesh.tet_regions.begin(), outcome.mesh.tet_regions.end()), 2);
}

TEST(MeshScan, SaysWhatMakesNoSense) {
  ScanMeshOptions options;
  options.levels = {1000};
  EXPECT_EQ(code_of(two_balls(), options), "input.level");
  options.levels = {0};
  options.sizes.size = "no formula";
  EXPECT_EQ(code_of(two_balls(), options), "usage.formula");
  options.sizes.size = "100";
  EXPECT_EQ(code_of(two_balls(), options), "input.empty_mesh");
  options.sizes.size = "";
  options.mesher.bounds.alpha = -1;
  EXPECT_EQ(code_of(two_balls(), options), "usage.option");
  std::vector<std::uint8_t> labels(27, 0);
  std::fill_n(labels.begin(), 9, std::uint8_t{1});
  std::fill_n(labels.begin() + 9, 9, std::uint8_t{4});
  options = {};
  Scan map = make_scan(std::move(labels), {3, 3, 3}, Frame());
  map.header_of_labels = "the caller says so";
  EXPECT_EQ(code_of(map, options), "input.labels");
}

class Cancelled final : public Progress {
  bool cancelled() const override { return true; }
};

TEST(MeshScan, IsEmptyWhenCancelled) {
  ScanMeshOptions options;
  options.levels = {0};
  Cancelled progress;
  const MeshOutcome outcome = mesh_scan(two_balls(), options, progress);
  EXPECT_TRUE(outcome.cancelled);
  EXPECT_TRUE(outcome.mesh.vertices.empty());
}

TEST(MeshScan, MeshesTheLabelsOfABuffer) {
  std::vector<std::uint8_t> labels;
  for (const std::int16_t height : heights()) labels.push_back(height > 40 ? 2 : height > 0 ? 1 : 0);
  const Frame frame({Vec{kSpacingMm, 0, 0}, Vec{0, kSpacingMm, 0}, Vec{0, 0, kSpacingMm}}, {});
  const Scan scan = make_scan(std::move(labels), {kSide, kSide, kSide}, frame);
  ScanMeshOptions options;
  options.labels = LabelSettings{};
  options.labels->smoothing = LabelSmoothing::keep;
  options.labels->names = {{2, "core"}};
  Progress progress;
  const MeshOutcome outcome = mesh_scan(scan, options, progress);
  EXPECT_EQ(outcome.findings, std::vector<std::string>{});
  ASSERT_EQ(outcome.report.regions.size(), 3U);
  EXPECT_EQ(outcome.report.regions[2].name, "core");
  EXPECT_EQ(outcome.report.regions[2].components, 1U);
  EXPECT_TRUE(outcome.report.regions[1].grid.has_value());
  options.labels->smoothing = LabelSmoothing::gaussian;
  options.labels->gaussian_mm = 1;
  EXPECT_TRUE(mentions(mesh_scan(scan, options, progress).notes, "does not keep labels"));
  options.levels = {1};
  EXPECT_EQ(code_of(scan, options), "usage.labels");
}

}  // namespace
}  // namespace scantet
