#include "scantet/topology/level_distance.h"

#include <gtest/gtest.h>

#include "unit/image/test_scan.h"

namespace scantet {
namespace {

using namespace test;

constexpr std::array<double, 3> kSpacing{0.5, 0.8, 1.5};

std::vector<float> distances_of(const Scan& scan, double limit_mm) {
  const auto heights = make_height_grid(scan, {0, InsideSide::above, -50.0});
  return level_distances(SidedNodes(*heights, [](double h) { return -h; }), kSpacing, limit_mm);
}

/// Calls visit(place in mm, distance) for the nodes at least `margin` from the border.
template <class Visit>
void visit_inner(const Scan& scan, const std::vector<float>& distances, int margin, const Visit& visit) {
  const PaddedNodes all{scan.size};
  for (std::int64_t n = 0; n < all.count(); ++n) {
    const std::array<int, 3> node = all.node(n);
    EXPECT_EQ(all.number(node), n);
    bool inner = true;
    for (int axis = 0; axis < 3; ++axis) inner = inner && node[axis] >= margin && node[axis] < scan.size[axis] - margin;
    if (inner) visit(Vec{node[0] * kSpacing[0], node[1] * kSpacing[1], node[2] * kSpacing[2]}, distances[n]);
  }
}

TEST(LevelDistance, OfPlanesIsExact) {
  const Vec normal = (1 / length(Vec{0.6, -0.5, 0.62})) * Vec{0.6, -0.5, 0.62};
  const auto height = [&](const Vec& p) { return dot(normal, p) - 1.23; };
  const Scan scan = scan_of_function<double>({30, 24, 14}, [&](int i, int j, int k) {
    return height({i * kSpacing[0], j * kSpacing[1], k * kSpacing[2]});
  });
  constexpr double kLimit = 1.2;
  int near = 0;
  visit_inner(scan, distances_of(scan, kLimit), 3, [&](const Vec& p, float distance) {
    const double exact = std::abs(height(p));
    // The nearest place that is looked for is one of a node's, a voxel or two aside.
    EXPECT_GE(distance, std::min(exact, kLimit) - 1e-5);
    EXPECT_LE(distance, std::min(kLimit, exact + 0.4) + 1e-5);
    near += exact < 0.3 ? 1 : 0;
    EXPECT_NEAR(distance, std::min(exact, kLimit), exact < 0.3 ? 0.05 : 0.4);
  });
  EXPECT_GT(near, 50);
}

TEST(LevelDistance, OfABallIsThatToItsSphere) {
  const Vec center{8.1, 8.3, 8.4};
  const Scan scan = scan_of_function<double>({33, 21, 12}, [&](int i, int j, int k) {
    return 6 - distance(center, {i * kSpacing[0], j * kSpacing[1], k * kSpacing[2]});
  });
  visit_inner(scan, distances_of(scan, 4), 0, [&](const Vec& p, float found) {
    EXPECT_NEAR(found, std::min(4.0, std::abs(6 - distance(center, p))), 0.5);
  });
}

TEST(LevelDistance, EndsAtTheLimitAndInThePadding) {
  const Scan scan = scan_of_function<float>({9, 9, 9}, [](int, int, int k) { return k - 3.25; });
  const auto heights = make_height_grid(scan, {0, InsideSide::above, -50.0});
  const SidedNodes nodes(*heights, [](double h) { return -h; });
  const std::vector<float> distances = level_distances(nodes, {1, 1, 1}, 1.5);
  const auto at = [&](int i, int j, int k) { return distances[nodes.nodes().number({i, j, k})]; };
  EXPECT_FLOAT_EQ(at(4, 4, 3), 0.25F);
  EXPECT_FLOAT_EQ(at(4, 4, 4), 0.75F);
  EXPECT_FLOAT_EQ(at(4, 4, 2), 1.25F);
  EXPECT_FLOAT_EQ(at(4, 4, 1), 1.5F);
  EXPECT_FLOAT_EQ(at(4, 4, -1), 1.5F);
  EXPECT_LT(at(0, 4, 6), 0.2F) << "beside the padding";
}

}  // namespace
}  // namespace scantet
