// A thin sheet that a mesh has nothing of is found, and given points.
#include "scantet/check/lost_parts.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scantet/app/meshing.h"
#include "scantet/app/nearer_points.h"
#include "scantet/check/audit.h"
#include "scantet/image/level_set.h"
#include "scantet/labels/label_object.h"
#include "unit/image/test_scan.h"
#include "unit/labels/label_scan.h"

namespace scantet {
namespace {

constexpr double kSizeMm = 4;
constexpr int kReach = 36;  // of the sheet, along x

/// A block; with a sheet of 0.6 mm that sticks out of it, from x = 12 to kReach, or without.
std::unique_ptr<Domain> block(bool with_sheet) {
  const Scan scan = test::scan_of_function<float>({40, 20, 20}, [&](int i, int j, int k) {
    const bool in_block = i >= 2 && i <= 12 && std::min(j, k) >= 3 && std::max(j, k) <= 16;
    const bool in_sheet = with_sheet && i > 12 && i <= kReach && k == 10 && j >= 4 && j <= 15;
    return in_block || in_sheet ? 1.0 : 0.0;
  });
  return make_level_set(scan, {0.7, InsideSide::above, std::nullopt});
}

/// The same in labels, the sheet a voxel thick: a domain without cells.
std::unique_ptr<Domain> label_block(bool with_sheet) {
  Progress progress;
  const Scan scan = test::label_scan({40, 20, 20}, [&](int i, int j, int k) {
    const bool in_block = i >= 2 && i <= 12 && std::min(j, k) >= 3 && std::max(j, k) <= 16;
    return in_block || (with_sheet && i > 12 && i <= kReach && k == 10 && j >= 4 && j <= 15) ? 1 : 0;
  });
  return std::move(make_label_object(scan, {}, progress).domain);
}

TEST(LostParts, ASheetThatIsNotThereIsFound) {
  Progress progress;
  const UniformSize size(kSizeMm);
  const auto bare = block(false);
  const auto whole = block(true);
  const TetMesh mesh = mesh_domain(*bare, size, {}, progress).mesh;
  EXPECT_TRUE(find_lost_parts(mesh, *bare, size).empty());
  EXPECT_TRUE(find_lost_parts({}, *whole, size).empty());
  const std::vector<FarPlace> parts = find_lost_parts(mesh, *whole, size);
  ASSERT_FALSE(parts.empty());
  for (const FarPlace& part : parts) {
    EXPECT_GT(part.point.x, 12 + kFarInSizes * kSizeMm);
    EXPECT_NEAR(part.distance_mm, part.point.x - 12.3, 0.1);
  }
  std::size_t fewer = 0;
  for (const double share : {1.0, 0.5}) {
    const std::vector<Point> points = points_on_parts(*whole, parts, mesh.vertices, share);
    EXPECT_GT(points.size(), 2 * fewer) << share;
    fewer = points.size();
    const auto on_sheet = [](const Point& p) { return p.x > 14; };
    EXPECT_GT(std::ranges::count_if(points, on_sheet), 100);
    for (const Point& p : points) EXPECT_LT(*whole->residual_at(p), 1e-6);
  }
}

/// A block of voxels of 20, with another value in its middle, in so many voxels along i and j.
std::unique_ptr<Domain> block_around(double middle, int voxels_i = 1, int voxels_j = 1) {
  const Scan scan = test::scan_of_function<float>({32, 32, 32}, [&](int i, int j, int k) {
    if (i >= 16 && i < 16 + voxels_i && j >= 16 && j < 16 + voxels_j && k == 16) return middle;
    return std::min({i, j, k}) >= 2 && std::max({i, j, k}) <= 29 ? 20.0 : 0.0;
  });
  return make_level_set(scan, {10, InsideSide::above, std::nullopt});
}

/// How many lost parts the audit finds, by the distance measured.
std::uint64_t audited(const TetMesh& mesh, const Domain& domain, const SizingField& size) {
  const BoundaryDistance distance = measure_distance(mesh, domain, {.limit_mm = {}, .size = &size});
  AuditOptions options;
  options.distance = &distance;
  options.size = &size;
  std::uint64_t count = 0;
  for (const Finding& finding : audit(mesh, &domain, options).findings) {
    if (finding.code == "audit.lost_part") count += finding.count;
  }
  return count;
}

TEST(LostParts, AVoxelAtTheLevelHasNoWidth) {
  Progress progress;
  const UniformSize size(kSizeMm);
  const TetMesh mesh = mesh_domain(*block_around(20), size, {}, progress).mesh;
  EXPECT_TRUE(find_lost_parts(mesh, *block_around(10), size).empty());
  EXPECT_EQ(find_lost_parts(mesh, *block_around(9.5), size).size(), 1U);
  EXPECT_EQ(audited(mesh, *block_around(10), size), 0U);
  EXPECT_EQ(audited(mesh, *block_around(9.5), size), 1U);
}

TEST(LostParts, VoxelsSideBySideAtTheLevelHaveNoWidth) {
  Progress progress;
  const UniformSize size(kSizeMm);
  const TetMesh mesh = mesh_domain(*block_around(20), size, {}, progress).mesh;
  for (const int voxels_j : {1, 2}) {
    EXPECT_TRUE(find_lost_parts(mesh, *block_around(10, 2, voxels_j), size).empty()) << "an edge, a face";
    EXPECT_EQ(find_lost_parts(mesh, *block_around(9.5, 2, voxels_j), size).size(), 1U);
  }
}

TEST(LostParts, ASheetOfALabelIsFound) {
  Progress progress;
  const UniformSize size(kSizeMm);
  const auto bare = label_block(false);
  const auto whole = label_block(true);
  const TetMesh mesh = mesh_domain(*bare, size, {}, progress).mesh;
  EXPECT_TRUE(find_lost_parts(mesh, *bare, size).empty());
  const std::vector<FarPlace> parts = find_lost_parts(mesh, *whole, size);
  ASSERT_FALSE(parts.empty());
  for (const FarPlace& part : parts) EXPECT_NEAR(part.distance_mm, part.point.x - 12.5, 0.6);
  const std::vector<Point> points = points_on_parts(*whole, parts, mesh.vertices, 1);
  EXPECT_GT(std::ranges::count_if(points, [](const Point& p) { return p.x > 14; }), 100);
  for (const Point& p : points) EXPECT_LT(*whole->residual_at(p), 1e-6);
}

TEST(LostParts, ASheetMuchThinnerThanTheSizeIsMeshed) {
  Progress progress;
  const auto whole = block(true);
  const auto size = std::make_shared<UniformSize>(kSizeMm);
  const Meshing meshing = *mesh_and_optimize(*whole, size, {}, {}, progress);
  EXPECT_TRUE(meshing.lost_parts.empty());
  double farthest = 0;
  for (const Point& p : meshing.refined.mesh.vertices) farthest = std::max(farthest, p.x);
  EXPECT_NEAR(farthest, kReach + 0.3, 0.1);
}

}  // namespace
}  // namespace scantet
