// Threads, tunnels and sheets that are known, and noise.
#include "scantet/topology/narrow_ways.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "scantet/field/height_grid.h"
#include "scantet/image/level_set.h"
#include "unit/image/test_scan.h"

namespace scantet {
namespace {

using namespace test;

constexpr std::array<int, 3> kSize{13, 11, 9};

std::vector<NarrowWay> ways_of(const Scan& scan, double outside = -10, LevelGround ground = LevelGround::ends_ways) {
  std::vector<NarrowWay> ways;
  narrow_ways(*make_height_grid(scan, {0, InsideSide::above, outside}), scan.frame, ground,
              [&](const NarrowWay& way) { ways.push_back(way); });
  return ways;
}

bool has_way(const std::vector<NarrowWay>& ways, const Frame& frame, const Vec& from, const Vec& to) {
  const Point a = frame.to_world(from);
  const Point b = frame.to_world(to);
  return std::any_of(ways.begin(), ways.end(), [&](const NarrowWay& way) {
    return distance(way.segment.source, a) < 1e-6 && distance(way.segment.target, b) < 1e-6;
  });
}

/// Two blocks along x, joined by a row of nodes that are lower towards its middle, at (6, 5, 4), by `fall` from one to
/// the next.
Scan dumbbell(double sign, const Frame& frame, double fall = 1) {
  return scan_of_function<float>(
      kSize,
      [sign, fall](int i, int j, int k) {
        const bool block = (i >= 1 && i <= 3) || (i >= 9 && i <= 11);
        if (block && j >= 3 && j <= 7 && k >= 2 && k <= 6) return 5 * sign;
        if (j == 5 && k == 4 && i > 3 && i < 9) return (1 + fall * std::abs(i - 6)) * sign;
        return -5 * sign;
      },
      frame);
}

bool has_way_between(const std::vector<NarrowWay>& ways, const Frame& frame, const Vec& a, const Vec& b) {
  return has_way(ways, frame, a, b) || has_way(ways, frame, b, a);
}

TEST(NarrowWays, AThreadIsFollowedFromItsLowestNodeToBothEnds) {
  for (const auto& [name, frame] : frames()) {
    SCOPED_TRACE(name);
    for (const double sign : {1.0, -1.0}) {
      const std::vector<NarrowWay> ways = ways_of(dumbbell(sign, frame));
      for (const int step : {-1, 1}) {
        for (int n = 0; n < 3; ++n) {
          EXPECT_TRUE(has_way(ways, frame, {6.0 + step * n, 5, 4}, {6.0 + step * (n + 1), 5, 4})) << step << ' ' << n;
        }
      }
    }
  }
}

TEST(NarrowWays, AThreadThatIsLevelIsFollowedFromEndToEnd) {
  for (const double sign : {1.0, -1.0}) {
    const std::vector<NarrowWay> ways = ways_of(dumbbell(sign, Frame(), 0));
    for (int i = 3; i < 9; ++i) EXPECT_TRUE(has_way_between(ways, Frame(), {i + 0.0, 5, 4}, {i + 1.0, 5, 4})) << i;
  }
}

/// How many of the steps along the thread are ways.
int steps_along_thread(const Scan& scan, LevelGround ground) {
  const std::vector<NarrowWay> ways = ways_of(scan, -10, ground);
  int count = 0;
  for (int i = 3; i < 9; ++i) count += has_way_between(ways, scan.frame, {i + 0.0, 5, 4}, {i + 1.0, 5, 4}) ? 1 : 0;
  return count;
}

TEST(NarrowWays, WhereNodesAreAtTheLevelTheyLeadAcrossLevelGroundIfAsked) {
  const auto scan = scan_of_function<float>(kSize, [](int i, int j, int k) {
    if (k == 0) return 0.0;
    const bool is_block = (i >= 1 && i <= 3) || (i >= 9 && i <= 11);
    if (is_block && j >= 3 && j <= 7 && k >= 2 && k <= 6) return 5.0;
    return j == 5 && k == 4 && i > 3 && i < 9 ? 1.0 : -5.0;
  });
  EXPECT_LT(steps_along_thread(scan, LevelGround::ends_ways), 6);
  EXPECT_EQ(steps_along_thread(scan, LevelGround::is_crossed), 6);
}

TEST(NarrowWays, ASheetIsLookedAtWithinWhereItIsThinnest) {
  const auto scan = scan_of_function<float>(kSize, [](int i, int j, int k) {
    if (k != 4) return -5.0;
    return 1 + 0.5 * (std::abs(i - 6) + std::abs(j - 5));
  });
  const std::vector<NarrowWay> ways = ways_of(scan);
  EXPECT_TRUE(has_way(ways, scan.frame, {6, 5, 4}, {7, 5, 4}));
  EXPECT_TRUE(has_way(ways, scan.frame, {6, 5, 4}, {6, 4, 4}));
  EXPECT_TRUE(has_way(ways, scan.frame, {6, 5, 4}, {6.5, 4.5, 4})) << "and across a face";
}

TEST(NarrowWays, ABallHasNone) {
  const auto scan =
      scan_of_function<float>(kSize, [](int i, int j, int k) { return 3.4 - std::hypot(i - 6.1, j - 5.2, k - 4.3); });
  EXPECT_TRUE(ways_of(scan).empty());
}

TEST(NarrowWays, EachLiesInItsRegionAndIsListedOnce) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise;
  for (const auto& [name, frame] : frames()) {
    SCOPED_TRACE(name);
    const auto scan = scan_of_function<float>(
        kSize, [&](int, int, int) { return noise(random); }, frame);
    const auto domain = make_level_set(scan, {0, InsideSide::above, -3.0});
    const std::vector<NarrowWay> ways = ways_of(scan, -3);
    std::set<std::array<double, 6>> known;
    std::array<int, 2> count{};
    for (const NarrowWay& way : ways) {
      ++count.at(static_cast<std::size_t>(way.region));
      const auto& [a, b] = way.segment;
      EXPECT_TRUE(known.insert({a.x, a.y, a.z, b.x, b.y, b.z}).second);
      for (int n = 0; n <= 20; ++n) EXPECT_EQ(domain->region_at(a + n / 20.0 * (b - a)), way.region);
    }
    EXPECT_GT(count[0], 100);
    EXPECT_GT(count[1], 100);
  }
}

}  // namespace
}  // namespace scantet
