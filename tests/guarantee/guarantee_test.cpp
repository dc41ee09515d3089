// One test for each promise of docs/guarantees.md, under the promise's name.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include "guarantee/fixture.h"
#include "guarantee/sample_table.h"
#include "guarantee/surface_distance.h"
#include "scantet/base/error.h"
#include "scantet/base/parallel.h"
#include "scantet/check/audit.h"
#include "scantet/check/rules_check.h"
#include "scantet/domain/analytic.h"
#include "scantet/image/level_set.h"
#include "scantet/io/mesh_io.h"
#include "scantet/io/sha256.h"
#include "scantet/optimize/optimizer.h"
#include "scantet/quality/quality.h"
#include "scantet/reading/scan_reader.h"
#include "scantet/refine/mesher.h"
#include "scantet/sizing/boundary_size.h"
#include "scantet/sizing/feature_size.h"
#include "scantet/sizing/size_formula.h"
#include "scantet/sizing/size_grid.h"
#include "scantet/topology/level_topology.h"

namespace scantet {
namespace {

struct Meshed {
  Scan scan;
  std::unique_ptr<Domain> domain;
  double size_mm = 0;
  MeshResult result;
};

/// A sample volume meshed at twice its voxel spacing, or at the given size.
Meshed mesh_sample(const Sample& sample, double voxels = 2) {
  Progress progress;
  Meshed m;
  m.scan = read_scan(sample_path(sample.file), progress);
  m.domain = make_level_set(m.scan, {sample.level, sample.inside, std::nullopt});
  m.size_mm = voxels * m.scan.frame.min_spacing_mm();
  m.result = mesh_domain(*m.domain, UniformSize(m.size_mm), {}, progress);
  return m;
}

std::string message_of(const AuditReport& report) {
  std::string text;
  for (const Finding& finding : report.findings) text += finding.message + "\n";
  return text;
}

std::uint64_t count_of(const AuditReport& report, const std::string& code) {
  for (const Finding& finding : report.findings) {
    if (finding.code == code) return finding.count;
  }
  return 0;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream bytes;
  bytes << in.rdbuf();
  return bytes.str();
}

TEST_F(Guarantee, TetsArePositive) {
  for (const Sample& sample : sample_table()) {
    const Meshed m = mesh_sample(sample);
    ASSERT_FALSE(m.result.mesh.tets.empty()) << sample.file;
    EXPECT_EQ(count_of(audit(m.result.mesh, nullptr), "audit.orientation"), 0U) << sample.file;
  }
}

TEST_F(Guarantee, MeshIsConforming) {
  for (const Sample& sample : sample_table()) {
    const Meshed m = mesh_sample(sample);
    const AuditReport report = audit(m.result.mesh, nullptr);
    EXPECT_TRUE(report.complete);
    EXPECT_TRUE(report.passed()) << sample.file << ": " << message_of(report);
  }
}

TEST_F(Guarantee, BoundaryIsOnTheLevel) {
  for (const Sample& sample : sample_table()) {
    const Meshed m = mesh_sample(sample);
    const AuditReport report = audit(m.result.mesh, m.domain.get());
    ASSERT_TRUE(report.max_residual.has_value());
    EXPECT_LE(*report.max_residual, 1e-6) << sample.file;
    EXPECT_GT(report.boundary_vertices, 0U);
  }
}

TEST_F(Guarantee, RulesHold) {
  for (const Sample& sample : sample_table()) {
    const Meshed m = mesh_sample(sample);
    ASSERT_EQ(m.result.stop, Stop::converged) << sample.file;
    const UnmetRules unmet =
        check_rules(m.result.sample, m.result.sample_dimensions, *m.domain, UniformSize(m.size_mm), {});
    EXPECT_EQ(unmet.total(), 0U) << sample.file;
  }
}

TEST_F(Guarantee, ComponentsAreKept) {
  for (const Sample& sample : sample_table()) {
    const Meshed m = mesh_sample(sample);
    const AuditReport report = audit(m.result.mesh, m.domain.get());
    EXPECT_EQ(report.components.size(), static_cast<std::size_t>(sample.components)) << sample.file;
    EXPECT_EQ(report.cavities, static_cast<std::uint64_t>(sample.cavities)) << sample.file;
    EXPECT_EQ(report.boundary_euler, sample.euler) << sample.file;
    EXPECT_TRUE(report.manifold()) << sample.file;
    EXPECT_TRUE(report.passed()) << sample.file << ": " << message_of(report);
  }
}

/// White noise: components, cavities, necks and gaps of every size below a voxel.
Scan noise_scan(unsigned seed) {
  constexpr int kSize = 9;
  auto voxels = std::make_shared<std::vector<float>>();
  std::mt19937 random(seed);
  for (int i = 0; i < kSize * kSize * kSize; ++i) voxels->push_back(static_cast<float>(random() % 1000003));
  const auto [min, max] = std::minmax_element(voxels->begin(), voxels->end());
  return {{kSize, kSize, kSize}, Frame(), voxels->data(), voxels, *min, *max, "float", "noise"};
}

TEST_F(Guarantee, ComponentsSurviveNoise) {
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    const Scan scan = noise_scan(seed);
    const auto domain = make_level_set(scan, {700000, InsideSide::above, std::nullopt});
    Progress progress;
    const MeshResult result = mesh_domain(*domain, UniformSize(1), {}, progress);
    ASSERT_EQ(result.stop, Stop::converged);
    AuditOptions options;
    options.restricted_delaunay = result.counts.absorbed_tets == 0;
    const AuditReport report = audit(result.mesh, domain.get(), options);
    EXPECT_EQ(report.non_manifold_edges, 0U) << seed << ": " << message_of(report);
    EXPECT_EQ(report.non_manifold_vertices, count_of(report, "audit.boundary_vertex")) << "what is left is reported";
    EXPECT_LE(report.non_manifold_vertices, report.boundary_vertices / 100);
    EXPECT_LE(report.max_residual.value(), 1e-6);
    std::uint64_t components = 0;
    for (const Component& component : domain->components()) components += component.region != kOutside ? 1 : 0;
    EXPECT_EQ(report.components.size(), components) << seed;
  }
}

TEST_F(Guarantee, FailureIsReported) {
  // A mesh of the wrong object is found out; so is one with bounds it cannot meet. The exit status: tests/cli.
  const Meshed m = mesh_sample(sample_named("sphere.nrrd"));
  const auto other = make_level_set(m.scan, {150, InsideSide::above, std::nullopt});
  EXPECT_GT(count_of(audit(m.result.mesh, other.get()), "audit.off_boundary"), 0U);
  MesherOptions options;
  options.max_vertices = 2000;
  Progress progress;
  const MeshResult stopped = mesh_domain(*m.domain, UniformSize(1), options, progress);
  EXPECT_EQ(stopped.stop, Stop::limit);
  EXPECT_GT(stopped.counts.unmet.total(), 0U);
  EXPECT_TRUE(stopped.limit.has_value());
}

TEST_F(Guarantee, FrameIsHonoured) {
  constexpr Point kCenter{12, -7, 31};  // of the ellipsoid, sample_volumes/shapes.cpp
  double reference = 0;
  const Sample& axis = sample_named("ellipsoid_axis.nrrd");
  const Meshed plain = mesh_sample(axis, 1.5);
  for (const Sample& sample : sample_table()) {
    if (sample.file.rfind("ellipsoid", 0) != 0) continue;
    // One size in mm for all frames, fine enough that the flatness of facets is below the tolerance.
    Progress progress;
    const Scan scan = read_scan(sample_path(sample.file), progress);
    const auto domain = make_level_set(scan, {sample.level, sample.inside, std::nullopt});
    MesherOptions options;
    options.bounds.facet_distance_mm = 0.01;
    const MeshResult result = mesh_domain(*domain, UniformSize(1.5), options, progress);
    const double volume = measure_quality(result.mesh).total_volume_mm3;
    if (reference == 0) reference = volume;
    EXPECT_NEAR(volume, reference, 1e-3 * reference) << sample.file;
    EXPECT_NEAR(volume, sample.volume_mm3, 2e-3 * sample.volume_mm3) << sample.file;
    EXPECT_EQ(count_of(audit(result.mesh, nullptr), "audit.orientation"), 0U) << sample.file;
    // The right place: on the ellipsoid x²/20² + y²/15² + z²/12² = 1, as far as the grid resolves it, in any frame.
    const Box box = plain.domain->bounds();
    for (std::size_t v = 0; v < result.mesh.vertices.size(); ++v) {
      const Point p = result.mesh.vertices[v];
      EXPECT_TRUE(box.contains(p)) << sample.file;
      if (!result.mesh.on_boundary(v)) continue;
      EXPECT_LE(domain->residual_at(p).value(), 1e-6);
      const double q =
          std::sqrt(squared_length({(p.x - kCenter.x) / 20, (p.y - kCenter.y) / 15, (p.z - kCenter.z) / 12}));
      EXPECT_NEAR(q, 1, 0.003) << sample.file;
    }
  }
}

TEST_F(Guarantee, SameBytes) {
  for (const char* name : {"torus.nrrd", "islands.nii.gz"}) {
    for (const char* extension :
         {".vtu", ".msh", ".mesh", ".stl", ".ply", ".inp", ".feb", ".bdf", ".e", ".med", ".vtk"}) {
      const std::string first = (folder_ / ("first" + std::string(extension))).string();
      const std::string second = (folder_ / ("second" + std::string(extension))).string();
      static std::map<std::string, std::array<Meshed, 2>> meshes;
      if (meshes.count(name) == 0) {
        meshes[name][0] = mesh_sample(sample_named(name));
        meshes[name][1] = mesh_sample(sample_named(name));
      }
      write_mesh(meshes[name][0].result.mesh, first);
      write_mesh(meshes[name][1].result.mesh, second);
      EXPECT_FALSE(bytes_of(first).empty());
      EXPECT_TRUE(bytes_of(first) == bytes_of(second)) << name << extension;
    }
  }
}

TEST_F(Guarantee, ThreadsDoNotMatter) {
  struct Case {
    const char* file;
    double voxels;  ///< the size over the voxel spacing: small enough for several parts of space
    Seeding seeding;
  };
  const std::vector<Case> cases{{"sphere.nrrd", 0.55, Seeding::bulk},
                                {"torus.nrrd", 0.5, Seeding::paper},
                                {"tanglecube.nrrd", 0.9, Seeding::paper},
                                {"shell.mha", 0.5, Seeding::bulk},
                                {"islands.nii.gz", 0.25, Seeding::bulk}};
  for (const Case& c : cases) {
    const Sample& sample = sample_named(c.file);
    Progress progress;
    const Scan scan = read_scan(sample_path(sample.file), progress);
    const auto domain = make_level_set(scan, {sample.level, sample.inside, std::nullopt});
    std::string first;
    for (const std::uint64_t threads : {1, 2, 3, 4, 8}) {
      MesherOptions options;
      options.threads = threads;
      options.seeding = c.seeding;
      const UniformSize size(c.voxels * scan.frame.min_spacing_mm());
      MeshResult result = mesh_domain(*domain, size, options, progress);
      EXPECT_GT(result.sample.size(), 24'000U) << c.file << ": too few to be refined in several parts";
      with_threads(threads, [&] {
        optimize_mesh(result.mesh, *domain, {Optimize::full, {.min_dihedral_deg = 20}}, progress);
      });
      const std::string path = (folder_ / "mesh.vtu").string();
      write_mesh(result.mesh, path);
      const std::string hash = sha256_file(path);
      if (first.empty()) first = hash;
      EXPECT_EQ(hash, first) << c.file << ", " << threads << " threads";
    }
  }
}

/// A formula, and a share of the feature size.
std::vector<std::shared_ptr<const SizingField>> varied_sizes(const Domain& domain, double voxel_mm) {
  Progress progress;
  SizeGridOptions options;
  options.longest_mm = domain.bounds().diagonal();
  const SizeFormula formula("x < 0 ? 1 + 0.3*d : 2.5", "--size");
  FeatureSizes features = feature_sizes(domain, {std::nullopt, voxel_mm}, progress);
  for (Cone& cone : features.sizes) cone.height_mm = std::max(voxel_mm, 0.3 * cone.height_mm);
  return {make_size_grid(domain, formula, options, progress),
          std::make_shared<BoundarySize>(features.sizes, features.spacing_mm, false)};
}

TEST_F(Guarantee, SizesThatVaryAreKept) {
  for (const char* file : {"torus.nrrd", "tanglecube.nrrd"}) {
    const Sample& sample = sample_named(file);
    Progress progress;
    const Scan scan = read_scan(sample_path(sample.file), progress);
    const auto domain = make_level_set(scan, {sample.level, sample.inside, std::nullopt});
    std::vector<std::string> first;
    for (const std::uint64_t threads : {1, 2, 8}) {
      std::vector<std::string> hashes;
      with_threads(threads, [&] {
        for (const auto& size : varied_sizes(*domain, scan.frame.min_spacing_mm())) {
          MesherOptions options;
          options.threads = threads;
          const MeshResult result = mesh_domain(*domain, *size, options, progress);
          ASSERT_EQ(result.stop, Stop::converged) << file;
          EXPECT_EQ(check_rules(result.sample, result.sample_dimensions, *domain, *size, options).total(), 0U) << file;
          EXPECT_EQ(audit(result.mesh, domain.get()).boundary_euler, sample.euler) << file;
          const std::string path = (folder_ / "mesh.vtu").string();
          write_mesh(result.mesh, path);
          hashes.push_back(sha256_file(path));
        }
      });
      if (first.empty()) first = hashes;
      EXPECT_EQ(hashes, first) << file << ", " << threads << " threads";
    }
  }
}

TEST_F(Guarantee, DihedralAnglesAreAsAsked) {
  for (const Sample& sample : sample_table()) {
    Meshed m = mesh_sample(sample);
    Progress progress;
    optimize_mesh(m.result.mesh, *m.domain, {Optimize::full, {.min_dihedral_deg = 10}}, progress);
    EXPECT_GE(measure_quality(m.result.mesh).min_dihedral_deg(), 10) << sample.file;
  }
}

TEST_F(Guarantee, ImprovingKeepsTheBoundary) {
  for (const char* file : {"sphere.nrrd", "torus.nrrd", "shell.mha", "tanglecube.nrrd"}) {
    Meshed m = mesh_sample(sample_named(file), 3);
    const TetMesh refined = m.result.mesh;
    const AuditReport before = audit(refined, m.domain.get());
    const double spacing_mm = 0.3 * m.size_mm;
    const SurfaceDistance near = surface_distance(refined, *m.domain, spacing_mm, m.size_mm);
    for (const double target_deg : {10.0, 25.0}) {
      TetMesh mesh = refined;
      Progress progress;
      optimize_mesh(mesh, *m.domain, {Optimize::full, {.min_dihedral_deg = target_deg}}, progress);
      EXPECT_NE(mesh.tets, refined.tets) << file << ": nothing to improve";
      AuditOptions options;
      options.restricted_delaunay = false;
      const AuditReport after = audit(mesh, m.domain.get(), options);
      EXPECT_TRUE(after.passed()) << file << ": " << message_of(after);
      EXPECT_EQ(after.boundary_euler, before.boundary_euler) << file;
      EXPECT_EQ(after.boundary_components, before.boundary_components) << file;
      EXPECT_EQ(after.components.size(), before.components.size()) << file;
      EXPECT_LE(after.max_residual.value(), 1e-6) << file;
      const SurfaceDistance now = surface_distance(mesh, *m.domain, spacing_mm, m.size_mm);
      EXPECT_LE(now.from_mesh_mm, 1.05 * near.from_mesh_mm) << file << ", " << target_deg;
      EXPECT_LE(now.from_domain_mm, 1.05 * near.from_domain_mm) << file << ", " << target_deg;
      EXPECT_GE(measure_quality(mesh).min_dihedral_deg(), measure_quality(refined).min_dihedral_deg()) << file;
    }
  }
}

TEST_F(Guarantee, WholeFilesOnly) {
  const Meshed m = mesh_sample(sample_named("sphere.nrrd"));
  const std::string path = (folder_ / "mesh.vtu").string();
  std::ofstream(path) << "older";
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit tiny{4096, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &tiny), 0);
  bool refused = false;
  try {
    write_mesh(m.result.mesh, path);
  } catch (const Error& error) {
    refused = error.fault() == Fault::output;
  }
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_TRUE(refused);
  EXPECT_EQ(bytes_of(path), "older");
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_)) ++files;
  EXPECT_EQ(files, 1) << "no unfinished file is left";
}

TEST_F(Guarantee, RunsEnd) {
  const Meshed m = mesh_sample(sample_named("sphere.nrrd"));
  Progress progress;
  for (const double facet : {0.55, 0.9, 3.0}) {
    for (const double cell : {0.62, 1.2, 5.0}) {
      MesherOptions options;
      options.bounds.facet_radius_edge = facet;
      options.bounds.cell_radius_edge = cell;
      options.max_vertices = 6000;
      const MeshResult result = mesh_domain(*m.domain, UniformSize(4), options, progress);
      EXPECT_TRUE(result.stop == Stop::converged || result.limit.has_value()) << facet << " " << cell;
    }
  }
}

TEST_F(Guarantee, MemoryIsBounded) {
  for (const Sample& sample : sample_table()) {
    Progress progress;
    const Scan scan = read_scan(sample_path(sample.file), progress);
    const LevelTopology topology(scan, {sample.level, sample.inside, std::nullopt});
    const auto voxel_bytes = std::visit([](const auto* voxels) { return sizeof(*voxels); }, scan.voxels);
    const auto scan_bytes = static_cast<std::size_t>(scan.voxel_count()) * voxel_bytes;
    constexpr std::size_t kFixed = 1024;  // the class itself, whatever the scan
    constexpr std::size_t kPerComponent = 160;
    EXPECT_LE(topology.memory_bytes(), scan_bytes * 15 / 100 + kFixed + kPerComponent * topology.components().size())
        << sample.file;
  }
}

}  // namespace
}  // namespace scantet
