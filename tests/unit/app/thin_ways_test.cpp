// A spike much thinner than the elements is found by the edges of the grid within it.
#include "scantet/app/thin_ways.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scantet/app/meshing.h"
#include "scantet/check/distance.h"
#include "scantet/image/level_set.h"
#include "unit/image/test_scan.h"
#include "unit/solids.h"

namespace scantet {
namespace {

constexpr double kTip = 16;  // of the spike, along x

/// A block, and out of it a spike 0.2 voxels thick, a row of nodes.
std::unique_ptr<Domain> block_with_spike() {
  const Scan scan = test::scan_of_function<float>({30, 18, 18}, [](int i, int j, int k) {
    const bool in_block = i >= 2 && i <= 12 && std::min(j, k) >= 3 && std::max(j, k) <= 14;
    if (in_block) return 1.0;
    return i > 12 && i <= kTip && j == 8 && k == 9 ? 0.1 : -1.0;
  });
  return make_level_set(scan, {0, InsideSide::above, std::nullopt});
}

TEST(ThinWays, LieInTheirRegionsAndReachThePlace) {
  const auto domain = block_with_spike();
  const Point tip{kTip + 0.09, 8, 9};
  const std::vector<NarrowWay> ways = ways_to(*domain, std::vector<Point>{tip}, 0.5);
  Crossings crossings;
  bool is_along_spike = false;
  for (const NarrowWay& way : ways) {
    domain->crossings(way.segment, crossings);
    EXPECT_TRUE(crossings.empty());
    EXPECT_EQ(domain->region_at(way.segment.target), way.region);
    const Point middle = lerp(way.segment.source, way.segment.target, 0.5);
    is_along_spike = is_along_spike || (way.region != kOutside && distance(middle, {kTip - 0.5, 8, 9}) < 1e-6);
  }
  EXPECT_TRUE(is_along_spike);
  EXPECT_TRUE(ways_to(*domain, {}, 0.5).empty());
}

TEST(ThinWays, ADomainWithoutCellsHasNone) {
  const test::Solids ball({{{0, 0, 0}, 2}}, {});
  EXPECT_TRUE(ways_to(ball, std::vector<Point>{{2, 0, 0}}, 0.5).empty());
}

TEST(ThinWays, BringAMeshWithinTheDistanceOfASpike) {
  const auto domain = block_with_spike();
  const auto size = std::make_shared<UniformSize>(3);
  Progress progress;
  const Meshing without = *mesh_and_optimize(*domain, size, {}, {Optimize::none, {}}, progress);
  EXPECT_GT(measure_distance(without.refined.mesh, *domain).to_mesh.lower_mm, 1.5) << "points alone do not show it";
  const Meshing with = *mesh_and_optimize(*domain, size, {}, {Optimize::none, {}}, progress, 1.0);
  EXPECT_LE(measure_distance(with.refined.mesh, *domain).to_mesh.lower_mm, 1);
  EXPECT_LT(with.refined.mesh.vertices.size(), 20 * without.refined.mesh.vertices.size());
}

}  // namespace
}  // namespace scantet
