// Components where nodes are at the level itself, against a count of samples.
#include "scantet/topology/level_joins.h"

#include <gtest/gtest.h>

#include <array>

#include "unit/image/parts_of_samples.h"
#include "unit/image/test_scan.h"

namespace scantet {
namespace {

using namespace test;

/// Whole numbers, a quarter of them at the level 10; no saddle of four others is there, as no products are equal.
Scan many_zeros(unsigned seed) {
  std::mt19937 random(seed);
  return scan_of_function<std::int16_t>({6, 5, 4}, [&](int, int, int) {
    constexpr std::array<int, 8> kHeights{0, 0, -2, -7, -11, 3, 5, 13};
    return 10 + kHeights[std::uniform_int_distribution<int>(0, 7)(random)];
  });
}

TEST(LevelJoins, WhatHasNoWidthCountsForNothing) {
  const LevelSetSettings settings{10, InsideSide::above, {}};
  int equal = 0;
  int apart = 0;
  const int repeats = 60;
  for (unsigned seed = 0; seed < repeats; ++seed) {
    SCOPED_TRACE(seed);
    const Scan scan = many_zeros(seed);
    const Counts found = counts(LevelTopology(scan, settings));
    const Counts samples = parts_of_samples(scan, settings, 8);
    EXPECT_LE(found.inside, samples.inside);
    EXPECT_LE(found.cavities, samples.cavities);
    equal += found == samples;
    apart += found.cavities != counts(LevelTopology(scan, {10 + 1e-7, InsideSide::above, {}})).cavities;
  }
  EXPECT_GE(equal, 0.7 * repeats);
  EXPECT_GT(apart, 0) << "there is something to tell apart";
}

TEST(LevelJoins, AVoidOfNodesAtTheLevelHasAVolumeIfACellIsOfThem) {
  const auto void_of = [](int width) {
    return counts(LevelTopology(scan_of_function<std::uint8_t>({8, 8, 8},
                                                               [&](int i, int j, int k) {
                                                                 const auto in = [](int n, int w) {
                                                                   return n >= 3 && n < 3 + w;
                                                                 };
                                                                 if (in(i, 2) && in(j, 2) && in(k, width)) return 5;
                                                                 return i > 0 && j > 0 && k > 0 ? 9 : 0;
                                                               }),
                                {5, InsideSide::above, {}}));
  };
  EXPECT_EQ(void_of(2), (Counts{1, 1}));
  EXPECT_EQ(void_of(1), (Counts{1, 0})) << "a sheet";
}

/// Slabs end after 31, 63 … layers; turned, the scan has none.
TEST(LevelJoins, SlabsAreSewnTogetherWhereNodesAreAtTheLevel) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    const Scan scan = plateaus<std::uint8_t>({5, 6, 100}, {}, seed);
    const auto* v = std::get<const std::uint8_t*>(scan.voxels);
    const auto turned = [&](int i, int j, int k) { return v[(i * 6 + k) * 5 + j]; };
    const LevelSetSettings settings{1, InsideSide::above, {}};
    EXPECT_EQ(counts(LevelTopology(scan, settings)),
              counts(LevelTopology(scan_of_function<std::uint8_t>({100, 5, 6}, turned), settings)));
  }
}

}  // namespace
}  // namespace scantet
