// What is promised of elements, on scans that nobody smoothed: Debian's mricron-data.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "boundary_flags.h"
#include "guarantee/fixture.h"
#include "scantet/app/meshing.h"
#include "scantet/base/mesh_topology.h"
#include "scantet/check/audit.h"
#include "scantet/delaunay/circumcentre.h"
#include "scantet/image/level_set.h"
#include "scantet/quality/quality.h"
#include "scantet/reading/scan_reader.h"
#include "unit/image/test_scan.h"

namespace scantet {
namespace {

/// Radius-edge ratios of up to 1 and 2, and of 1.5 times that where elements are smaller than half of the size.
void expect_ratios(const TetMesh& mesh, const SizingField& size, double rounding) {
  std::size_t small = 0;
  const auto expect = [&](double radius, const Point& center, double edge, double ratio) {
    const bool is_small = radius < 0.5 * size.size_at(center);
    EXPECT_LE(radius / edge, (is_small ? 1.5 : 1) * ratio * rounding);
    small += is_small && radius / edge > ratio ? 1 : 0;
  };
  const auto point = [&](VertexId v) { return mesh.vertices[v]; };
  for (const Triangle& f : mesh.boundary_facets) {
    const std::array<Point, 3> p{point(f[0]), point(f[1]), point(f[2])};
    const Point center = engine::circumcentre(p[0], p[1], p[2]);
    const double edge = std::min({distance(p[0], p[1]), distance(p[1], p[2]), distance(p[2], p[0])});
    expect(distance(center, p[0]), center, edge, 1);
  }
  for (const Tet& t : mesh.tets) {
    const std::array<Point, 4> p{point(t[0]), point(t[1]), point(t[2]), point(t[3])};
    const Point center = engine::circumcentre(p);
    expect(distance(center, p[0]), center, std::sqrt(engine::squared_shortest_edge(p)), 2);
  }
  EXPECT_GT(small, 0U);
}

/// A brain with its skull taken off: level 20 is rough, level 60.38 has 688 cavities, most of them smaller than a
/// voxel. (At 60 itself 2,900 voxels are at the level: there gaps have no width, and what is beside them may be of any
/// shape.)
class RoughScan : public Guarantee, public testing::WithParamInterface<double> {
 protected:
  void SetUp() override {
    const std::string brain = "/usr/share/mricron/templates/ch2bet.nii.gz";
    if (!std::filesystem::exists(brain)) GTEST_SKIP() << brain << " is not installed";
    domain_ = make_level_set(read_scan(brain, progress_), {GetParam(), InsideSide::above, std::nullopt});
  }

  Progress progress_;
  std::unique_ptr<Domain> domain_;
};

// Where fragments change sides, tets and facets come up that no rule was asked about, and improvement used to make
// more.
TEST_P(RoughScan, BoundsAreKept) {
  const auto size = std::make_shared<UniformSize>(4);
  const ElementBounds bounds{10, 165, 0.05, std::nullopt};
  const Meshing meshing = *mesh_and_optimize(*domain_, size, {}, {Optimize::full, bounds}, progress_);
  ASSERT_GT(meshing.refined.counts.absorbed_tets, 100U) << "the scan is rough";
  EXPECT_TRUE(meshing.conformance.holds()) << meshing.conformance.places.size() << " elements break a bound";
  // Measured once more by code of its own.
  const FinerSize finer(size, meshing.finer);
  const QualitySummary quality = measure_quality(meshing.refined.mesh, &finer);
  constexpr double kRounding = 1 + 1e-6;
  EXPECT_GE(quality.min_dihedral_deg(), 10);
  EXPECT_LE(quality.max_dihedral_deg(), 165);
  EXPECT_GE(quality.scaled_jacobian.min, 0.05);
  expect_ratios(meshing.refined.mesh, finer, kRounding);
  EXPECT_LE(quality.size_ratio->max, kRounding);
  EXPECT_LE(quality.max_circumradius_mm(), 4 * kRounding);
}

// A vertex that untangling left behind the boundary is an inner one: a condition set on the boundary must not hold it.
TEST_P(RoughScan, BoundaryVerticesAreThoseOfFacets) {
  MeshResult result = mesh_domain(*domain_, UniformSize(5), {}, progress_);
  EXPECT_EQ(test::boundary_flags(result.mesh), vertices_of_boundary(result.mesh));
  const auto sampled = std::count(result.sample_dimensions.begin(), result.sample_dimensions.end(), 2);
  const std::vector<std::uint8_t> flags = test::boundary_flags(result.mesh);
  const auto flagged = std::count(flags.begin(), flags.end(), 1);
  ASSERT_LT(flagged, sampled) << "none was left behind: this shows nothing";
  optimize_mesh(result.mesh, *domain_, {}, progress_);
  EXPECT_EQ(test::boundary_flags(result.mesh), vertices_of_boundary(result.mesh));
}

// Voxels of 0 and 1 in turn touch along all their edges at 0.5: no sample keeps them apart.
TEST(Checkerboard, EndsByItself) {
  const Scan scan =
      test::scan_of_function<std::uint8_t>({5, 5, 5}, [](int i, int j, int k) { return (i + j + k) % 2; });
  const auto domain = make_level_set(scan, {0.5, InsideSide::above, std::nullopt});
  MesherOptions options;
  options.max_vertices = 100'000;
  Progress progress;
  const MeshResult result = mesh_domain(*domain, UniformSize(2), options, progress);
  EXPECT_EQ(result.stop, Stop::converged) << result.mesh.vertices.size() << " vertices";
}

// A sheet of a fiftieth of a voxel: no tet of the size fits in, and the mesh keeps a tet or two of it.
TEST(ThinSheet, IsToldAsLost) {
  const auto in_sheet = [](int i, int j, int k) { return k == 8 && std::min(i, j) > 2 && std::max(i, j) < 13; };
  const Scan scan = test::scan_of_function<float>({16, 16, 16}, in_sheet);
  const auto domain = make_level_set(scan, {0.99, InsideSide::above, std::nullopt});
  const auto size = std::make_shared<UniformSize>(2);
  Progress progress;
  const Meshing meshing = *mesh_and_optimize(*domain, size, {}, {}, progress);
  const BoundaryDistance distance = measure_distance(meshing.refined.mesh, *domain);
  AuditOptions options;
  options.restricted_delaunay = false;
  options.distance = &distance;
  options.size = size.get();
  const AuditReport report = audit(meshing.refined.mesh, domain.get(), options);
  const auto is_lost = [](const Finding& finding) { return finding.code == "audit.lost_part"; };
  EXPECT_TRUE(std::any_of(report.findings.begin(), report.findings.end(), is_lost));
}

// A wide one, uneven by as much as it is thick: each round of points left more pinches than the one before, without
// end.
TEST(ThinSheet, IsLeftOutBesideARod) {
  const auto value = [](int i, int j, int k) {
    if (i >= 8 && i <= 12 && j >= 8 && j <= 12 && k >= 12 && k <= 22) return 1.0;
    const bool in_sheet = k == 6 && std::min(i, j) > 3 && std::max(i, j) < 60;
    return in_sheet ? 0.005 * (1 + (7 * i + 13 * j) % 11) : -1;
  };
  const auto domain =
      make_level_set(test::scan_of_function<float>({64, 64, 28}, value), {0, InsideSide::above, std::nullopt});
  Progress progress;
  const MeshResult result = mesh_domain(*domain, UniformSize(2), {}, progress);
  EXPECT_FALSE(result.thin_sheets.empty());
  for (const Point& p : result.thin_sheets) EXPECT_NEAR(p.z, 6, 0.2);
  EXPECT_LT(result.counts.repair_points, 50'000U);
  const auto in_rod = [](const Point& p) { return p.z > 10; };
  EXPECT_GT(std::count_if(result.mesh.vertices.begin(), result.mesh.vertices.end(), in_rod), 40);
  EXPECT_TRUE(std::none_of(result.tangled.begin(), result.tangled.end(), in_rod));
}

INSTANTIATE_TEST_SUITE_P(Levels, RoughScan, testing::Values(20.0, 60.38));

}  // namespace
}  // namespace scantet
