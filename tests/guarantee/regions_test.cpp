// The promise about several regions, of docs/guarantees.md, under its name.
#include <gtest/gtest.h>

#include "guarantee/fixture.h"
#include "guarantee/sample_table.h"
#include "sample.h"
#include "scantet/base/parallel.h"
#include "scantet/check/audit.h"
#include "scantet/check/rules_check.h"
#include "scantet/image/nested_level_sets.h"
#include "scantet/io/mesh_io.h"
#include "scantet/io/sha256.h"
#include "scantet/optimize/optimizer.h"
#include "scantet/quality/quality.h"
#include "scantet/reading/scan_reader.h"
#include "scantet/refine/mesher.h"

namespace scantet {
namespace {

struct Nested {
  std::string name;
  Scan scan;
  NestedLevelSettings settings;
  double size_mm;
  std::vector<std::int64_t> euler;  ///< of the level sets, outermost first
};

Scan scan_of(const std::string& sample) {
  Progress progress;
  return read_scan(sample_path(sample), progress);
}

/// A function of the place as seen from the middle, mm.
Scan scan_around_a_point(double (*value)(const Vec&)) {
  constexpr int kSize = 41;
  auto voxels = std::make_shared<std::vector<float>>();
  for (int n = 0; n < kSize * kSize * kSize; ++n) {
    const Vec p{double(n % kSize), double(n / kSize % kSize), double(n / kSize / kSize)};
    voxels->push_back(static_cast<float>(value(p - Vec{20, 20, 20})));
  }
  const auto [min, max] = std::minmax_element(voxels->begin(), voxels->end());
  return {{kSize, kSize, kSize}, Frame(), voxels->data(), voxels, *min, *max, "float", "made up"};
}

std::vector<Nested> nested_cases() {
  // Their level sets are spheres, but for the trilinear interpolation.
  const Scan ball = scan_around_a_point([](const Vec& p) { return 20 - length(p); });
  const Scan shell = scan_around_a_point([](const Vec& p) { return std::abs(length(p) - 10); });
  // Levels 0 and 1.2 are 1.2 mm apart on one side and narrow to a tenth of that on the other.
  const Scan narrowing =
      scan_around_a_point([](const Vec& p) { return (7 - length(p)) * std::max(1.0, 5.5 + 9 / 14.0 * p.x); });
  std::vector<Nested> cases;
  const auto add = [&](const std::string& name, const Scan& scan, std::vector<double> levels, InsideSide side,
                       double size_mm, std::vector<std::int64_t> euler) {
    cases.push_back({name, scan, {std::move(levels), side, std::nullopt}, size_mm, std::move(euler)});
  };
  add("ball", ball, {6, 11}, InsideSide::above, 1.2, {2, 2});
  add("three in a ball", ball, {11, 5, 8}, InsideSide::above, 1.2, {2, 2, 2});
  add("shell", shell, {3, 5}, InsideSide::below, 1.2, {4, 4});
  add("narrowing gap", narrowing, {0, 1.2}, InsideSide::above, 1.2, {2, 2});
  add("torus", scan_of("torus.nrrd"), {300.5, 450}, InsideSide::above, 0.8, {0, 0});
  add("tanglecube", scan_of("tanglecube.nrrd"), {0.1, 150}, InsideSide::above, 1.3, {-8, 16});
  return cases;
}

TetMesh meshed(const Domain& domain, const Nested& c, std::uint64_t threads, std::uint64_t& absorbed) {
  MesherOptions options;
  options.threads = threads;
  options.bounds.alpha = 0.5;  // volumes are to be close
  Progress progress;
  MeshResult result = mesh_domain(domain, UniformSize(c.size_mm), options, progress);
  EXPECT_EQ(result.stop, Stop::converged) << c.name;
  const UnmetRules unmet =
      check_rules(result.sample, result.sample_dimensions, domain, UniformSize(c.size_mm), options);
  EXPECT_EQ(unmet.total(), 0U) << c.name;
  absorbed = result.counts.absorbed_tets;
  with_threads(threads, [&] {
    optimize_mesh(result.mesh, domain, {Optimize::full, {.min_dihedral_deg = 10}}, progress);
  });
  return std::move(result.mesh);
}

/// The volumes inside of each level set, outermost first, and 0: those of the field, by quadrature, with nothing of the
/// library but the voxels.
std::vector<double> volumes_inside(const Nested& c) {
  samples::Sample sample;
  for (int axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<std::size_t>(axis);
    sample.grid.size[n] = c.scan.size[n];
    for (int row = 0; row < 3; ++row)
      sample.grid.columns[n][static_cast<std::size_t>(row)] = c.scan.frame.column(axis)[row];
  }
  std::visit([&](const auto* voxels) { sample.voxels.assign(voxels, voxels + c.scan.voxel_count()); }, c.scan.voxels);
  sample.inside_above = c.settings.inside == InsideSide::above;
  std::vector<double> volumes{0};
  for (const double level : c.settings.levels) {
    sample.level = level;
    volumes.push_back(samples::trilinear_volume(sample).mm3);
  }
  std::sort(volumes.rbegin(), volumes.rend());
  return volumes;
}

TEST_F(Guarantee, RegionsConform) {
  for (const Nested& c : nested_cases()) {
    const auto domain = make_nested_level_sets(c.scan, c.settings);
    std::uint64_t absorbed = 0;
    const TetMesh mesh = meshed(*domain, c, 2, absorbed);
    EXPECT_EQ(absorbed, 0U) << c.name;
    AuditOptions options;
    options.restricted_delaunay = false;  // it is improved
    const AuditReport report = audit(mesh, domain.get(), options);
    for (const Finding& finding : report.findings) ADD_FAILURE() << c.name << ": " << finding.message;
    EXPECT_TRUE(report.manifold()) << c.name;

    // Each interface lies between neighbouring regions and has the topology of its level set.
    const std::size_t levels = c.settings.levels.size();
    ASSERT_EQ(report.interfaces.size(), levels) << c.name;
    for (const MeshInterface& i : report.interfaces) {
      EXPECT_EQ(std::abs(i.regions[0] - i.regions[1]), 1) << c.name;
      const auto level = static_cast<std::size_t>(std::max(i.regions[0], i.regions[1]) - 1);
      EXPECT_EQ(i.euler, c.euler[level]) << c.name << ", level " << level;
    }

    const std::vector<double> inside = volumes_inside(c);
    const std::vector<RegionVolume> regions = measure_quality(mesh).regions;
    ASSERT_EQ(regions.size(), levels) << c.name;
    for (std::size_t n = 0; n < levels; ++n) {
      const double volume = inside[n] - inside[n + 1];
      EXPECT_EQ(regions[n].region, static_cast<Region>(n + 1));
      EXPECT_NEAR(regions[n].volume_mm3, volume, 5e-3 * volume) << c.name << ", region " << n + 1;
    }
  }
}

TEST_F(Guarantee, RegionsConformWithAnyNumberOfThreads) {
  Nested c = nested_cases().front();
  c.size_mm = 0.75;  // enough points for several parts of space
  const auto domain = make_nested_level_sets(c.scan, c.settings);
  const std::string path = (folder_ / "mesh.vtu").string();
  std::string first;
  for (const std::uint64_t threads : {1, 2, 8}) {
    std::uint64_t absorbed = 0;
    const TetMesh mesh = meshed(*domain, c, threads, absorbed);
    EXPECT_GT(mesh.vertices.size(), 24'000U);
    write_mesh(mesh, path);
    const std::string hash = sha256_file(path);
    if (first.empty()) first = hash;
    EXPECT_EQ(hash, first) << threads << " threads";
  }
}

}  // namespace
}  // namespace scantet
