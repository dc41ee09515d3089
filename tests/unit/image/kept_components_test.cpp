// What is kept and what is dropped, counted again on the scan that comes out.
#include "scantet/image/kept_components.h"

#include <gtest/gtest.h>

#include <map>

#include "scantet/base/error.h"
#include "unit/image/node_reached.h"
#include "unit/image/parts_of_samples.h"
#include "unit/image/sides.h"
#include "unit/image/test_scan.h"

namespace scantet {
namespace {

using namespace test;

Counts counts_of(const Domain& domain) {
  Counts counts;
  for (const Component& component : domain.components()) {
    ++(component.region == kOutside ? counts.cavities : counts.inside);
  }
  return counts;
}

Counts counts_of(const Scan& scan, const NestedLevelSettings& settings) {
  return counts_of(*make_nested_level_sets(scan, settings));
}

std::unique_ptr<Domain> kept_domain(const Scan& scan, const NestedLevelSettings& settings,
                                    const ComponentChoice& choice) {
  return make_kept_level_sets(scan, settings, keep_components(scan, settings, choice), 0).domain;
}

Counts kept_counts(const Scan& scan, const NestedLevelSettings& settings, const ComponentChoice& choice) {
  return counts_of(*kept_domain(scan, settings, choice));
}

std::vector<double> dropped_volumes(const KeptComponents& kept) {
  std::vector<double> volumes;
  for (const Component& component : kept.dropped.components) volumes.push_back(component.volume_mm3);
  return volumes;
}

double value_at(const Scan& scan, int i, int j, int k) {
  const std::int64_t offset = (std::int64_t{k} * scan.size[1] + j) * scan.size[0] + i;
  return std::visit([&](const auto* voxels) { return static_cast<double>(voxels[offset]); }, scan.voxels);
}

/// Cubes of 3, 2, 2 and 1 voxels a side, of value 50 in 10, on voxels of 0.5 × 1 × 2 mm, 1 mm³ each.
Scan cubes() {
  const Frame frame({Vec{0.5, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 2}}, {10, 20, 30});
  return scan_of_function<std::uint8_t>(
      {16, 7, 7},
      [](int i, int j, int k) {
        const auto cube = [&](int low, int side) {
          return i >= low && i < low + side && j >= 2 && j < 2 + side && k >= 2 && k < 2 + side;
        };
        return cube(2, 3) || cube(7, 2) || cube(10, 2) || cube(13, 1) ? 50 : 10;
      },
      frame);
}

TEST(KeptComponents, AreTheLargestByVolumeAndOfEqualsTheFirst) {
  const Scan scan = cubes();
  const NestedLevelSettings settings{{20}, kAbove, {}};
  ASSERT_EQ(counts_of(scan, settings), (Counts{4, 0}));
  const auto volumes = [&](const ComponentChoice& choice) {
    const KeptComponents kept = keep_components(scan, settings, choice);
    EXPECT_EQ(kept.dropped.found, 4U);
    const std::vector<double> dropped = dropped_volumes(kept);
    EXPECT_EQ(kept_counts(scan, settings, choice), (Counts{4 - static_cast<int>(dropped.size()), 0}));
    return dropped;
  };
  using Volumes = std::vector<double>;
  EXPECT_EQ(volumes({1, 0}), (Volumes{8, 8, 1}));
  EXPECT_EQ(volumes({2, 0}), (Volumes{8, 1}));
  EXPECT_EQ(volumes({3, 0}), (Volumes{1}));
  EXPECT_EQ(volumes({{}, 8}), (Volumes{1}));
  EXPECT_EQ(volumes({{}, 8.001}), (Volumes{8, 8, 1}));
  EXPECT_EQ(volumes({2, 1.5}), (Volumes{8, 1}));
  EXPECT_EQ(volumes({3, 9}), (Volumes{8, 8, 1}));

  const KeptComponents two = keep_components(scan, settings, {2, 0});
  EXPECT_EQ(value_at(two.levels[0].scan, 7, 2, 2), 50) << "the first of the equals";
  EXPECT_EQ(value_at(two.levels[0].scan, 10, 2, 2), 19) << "just outside";
  EXPECT_EQ(value_at(scan, 10, 2, 2), 50) << "the scan itself stays as it is";
  EXPECT_EQ(two.dropped.components[0].witness, (Point{10 + 0.5 * 10, 22, 34}));
}

TEST(KeptComponents, WithNothingToDropAreTheScanItself) {
  const Scan scan = cubes();
  for (const ComponentChoice& choice : {ComponentChoice{4, 0}, ComponentChoice{9, 1}, ComponentChoice{{}, 1}}) {
    const KeptComponents kept = keep_components(scan, {{20}, kAbove, {}}, choice);
    EXPECT_EQ(kept.levels[0].scan.voxels, scan.voxels) << "no copy";
    EXPECT_EQ(kept.dropped.found, 4U);
    EXPECT_TRUE(kept.dropped.components.empty());
  }
}

TEST(KeptComponents, ThatTouchDiagonallyArePartedOrOneAsTheFieldHasIt) {
  const auto pair = [](double away) {
    return scan_of_function<float>({8, 8, 6}, [=](int i, int j, int k) {
      const bool large = i >= 1 && i < 4 && j >= 1 && j < 4;
      const bool small = i >= 4 && i < 6 && j >= 4 && j < 6;
      return k >= 1 && k < 5 && (large || small) ? 1 : away;
    });
  };
  const NestedLevelSettings settings{{0}, kAbove, {}};
  const KeptComponents parted = keep_components(pair(-1.5), settings, {1, 0});
  EXPECT_EQ(dropped_volumes(parted), (std::vector<double>{16}));
  EXPECT_EQ(kept_counts(pair(-1.5), settings, {1, 0}), (Counts{1, 0}));
  EXPECT_EQ(value_at(parted.levels[0].scan, 3, 3, 2), 1);
  EXPECT_NEAR(value_at(parted.levels[0].scan, 4, 4, 2), -0.0025, 1e-6) << "a thousandth of the range";
  EXPECT_EQ(parted.levels[0].shared->count(), 5U) << "the cells between the touching edges, ends included";
  const KeptComponents one = keep_components(pair(-0.5), settings, {1, 0});
  EXPECT_EQ(one.dropped.found, 1U) << "a saddle joins them";
}

/// 10 inside of a ball of radius 4 about (24, 7, 7), of a hollow one about (8, 8, 8), and of an island in its cavity.
Scan nested() {
  return scan_of_function<double>({33, 17, 17}, [](int i, int j, int k) {
    const double r = distance({8, 8, 8}, {double(i), double(j), double(k)});
    const double solid = distance({24, 7, 7}, {double(i), double(j), double(k)});
    return 10 * (r < 2.5 || (r > 5.2 && r < 6.6) || solid < 5.9 ? 1 : -1);
  });
}

TEST(KeptComponents, CavitiesAndIslandsInThem) {
  const NestedLevelSettings settings{{0}, kAbove, {}};
  ASSERT_EQ(counts_of(nested(), settings), (Counts{3, 1}));
  EXPECT_EQ(kept_counts(nested(), settings, {2, 0}), (Counts{2, 1})) << "the cavity stays without its island";
  EXPECT_EQ(kept_counts(nested(), settings, {1, 0}), (Counts{1, 0})) << "the cavity of a dropped shell goes with it";
  EXPECT_EQ(kept_domain(nested(), settings, {1, 0})->region_at({24, 7, 7}), 1) << "the solid ball is the largest";
  // Turned inside out, the solid ball, the shell and the island are cavities, the last one in the shell's hollow.
  const NestedLevelSettings dark{{0}, kBelow, 10.0};
  ASSERT_EQ(counts_of(nested(), dark), (Counts{2, 3}));
  EXPECT_EQ(kept_counts(nested(), dark, {1, 0}), (Counts{1, 2})) << "the hollow is filled";
}

TEST(KeptComponents, SmallCavitiesThatStayAreCounted) {
  const NestedLevelSettings settings{{0}, kAbove, {}};
  const KeptComponents kept = keep_components(nested(), settings, {2, 0});
  const double cavity = kept_domain(nested(), settings, {2, 0})->components().back().volume_mm3;
  const auto below = [&](double volume) { return make_kept_level_sets(nested(), settings, kept, volume).cavities; };
  EXPECT_EQ(below(cavity).count, 0U);
  EXPECT_EQ(below(cavity + 1).count, 1U);
  EXPECT_EQ(below(cavity + 1).least_mm3, cavity);
}

using Regions = std::map<Region, int>;

Regions regions_of(const Domain& domain) {
  Regions count;
  for (const Component& component : domain.components()) ++count[component.region];
  return count;
}

/// Cones of these heights on a slope of 10 a voxel, about (5, 5, 5), (17, 5, 5) and (29, 5, 5).
Scan cones(double first, double second, double third) {
  return scan_of_function<float>({36, 11, 11}, [=](int i, int j, int k) {
    const Point p{double(i), double(j), double(k)};
    return std::max({0.0, first - 10 * distance({5, 5, 5}, p), second - 10 * distance({17, 5, 5}, p),
                     third - 10 * distance({29, 5, 5}, p)});
  });
}

TEST(KeptComponents, GoWithWhatFurtherLevelsHaveInThem) {
  const NestedLevelSettings settings{{30, 10}, kAbove, {}};
  const Scan scan = cones(52, 42, 0);
  ASSERT_EQ(regions_of(*make_nested_level_sets(scan, settings)), (Regions{{1, 2}, {2, 2}}));
  const KeptComponents kept = keep_components(scan, settings, {1, 0});
  EXPECT_EQ(kept.dropped.found, 3U) << "two of region 1, and the one of region 2 that is left";
  ASSERT_EQ(kept.dropped.components.size(), 1U);
  EXPECT_EQ(kept.dropped.components[0].region, 1);
  const auto domain = kept_domain(scan, settings, {1, 0});
  EXPECT_EQ(regions_of(*domain), (Regions{{1, 1}, {2, 1}})) << "what is within goes, too";
  EXPECT_EQ(domain->region_at({17, 5, 5}), kOutside);
  EXPECT_EQ(domain->region_at({5, 5, 5}), 2);
}

TEST(KeptComponents, OfInnerLevelsAreChosenToo) {
  // One component at level 10, with three of level 30 in it.
  const Scan peaks = cones(72, 82, 62);
  const NestedLevelSettings settings{{10, 30}, kAbove, {}};
  ASSERT_EQ(regions_of(*make_nested_level_sets(peaks, settings)), (Regions{{1, 1}, {2, 3}}));
  const KeptComponents kept = keep_components(peaks, settings, {1, 0});
  EXPECT_EQ(kept.dropped.found, 4U);
  ASSERT_EQ(kept.dropped.components.size(), 2U);
  for (const Component& island : kept.dropped.components) EXPECT_EQ(island.region, 2);
  EXPECT_GT(kept.dropped.components[0].volume_mm3, kept.dropped.components[1].volume_mm3);
  EXPECT_EQ(kept.levels[0].scan.voxels, peaks.voxels) << "level 10 leaves nothing out: no copy";
  const auto domain = kept_domain(peaks, settings, {1, 0});
  EXPECT_EQ(regions_of(*domain), (Regions{{1, 1}, {2, 1}}));
  EXPECT_EQ(domain->region_at({5, 5, 5}), 1) << "the island is part of what is around it";
  EXPECT_EQ(domain->region_at({17, 5, 5}), 2);
  EXPECT_EQ(regions_of(*kept_domain(peaks, settings, {2, 0})), (Regions{{1, 1}, {2, 2}}));
  const double least = kept.dropped.components[0].volume_mm3;
  EXPECT_EQ(regions_of(*kept_domain(peaks, settings, {{}, least})), (Regions{{1, 1}, {2, 2}}));
}

TEST(KeptComponents, ALevelWithNothingLeftIsRefused) {
  const NestedLevelSettings high{{10, 45}, kAbove, {}};
  const Scan flat = scan_of_function<float>({24, 11, 11}, [](int i, int j, int k) {
    const double wide = 30 * (distance({6, 5, 5}, {double(i), double(j), double(k)}) < 5 ? 1 : 0);
    return std::max(wide, 50 - 20 * distance({18, 5, 5}, {double(i), double(j), double(k)}));
  });
  try {
    keep_components(flat, high, {1, 0});
    FAIL() << "nothing is left within the higher level";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), "input.components");
    EXPECT_NE(std::string(error.what()).find("level 45"), std::string::npos) << error.what();
  }
}

/// A cavity of one node whose wall, in the cell that a component of one node has a corner of, is thinner than a voxel.
TEST(KeptComponents, AWallBetweenACavityAndWhatIsDroppedStays) {
  const Scan scan = scan_of_function<float>({6, 6, 6}, [](int i, int j, int k) {
    const int away = std::max({std::abs(i - 3), std::abs(j - 3), std::abs(k - 3)});
    if (away == 0) return -2;
    if (i <= 2 && j <= 2 && k <= 2 && i + j + k == 6) return 10;
    if (i >= 2 && j >= 2 && k >= 2 && i <= 3 && j <= 3 && k <= 3 && i + j + k == 7) return -10;
    return away == 1 ? 5 : -10;
  });
  const NestedLevelSettings settings{{0}, kAbove, {}};
  ASSERT_EQ(counts_of(scan, settings), (Counts{2, 1}));
  const KeptComponents kept = keep_components(scan, settings, {1, 0});
  EXPECT_EQ(kept_counts(scan, settings, {1, 0}), (Counts{1, 1}));
  EXPECT_EQ(counts_of(kept.levels[0].scan, settings), (Counts{1, 0})) << "the copy by itself would open the wall";
}

TEST(KeptComponents, AreThePointsOfTheFieldThatClimbToThem) {
  std::size_t shared = 0;
  std::size_t left_out = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(0, 1);
    const std::array<int, 3> size{13, 12, 11};
    const Scan scan = scan_of_function<float>(size, [&](int, int, int) { return value(random); });
    const NestedLevelSettings settings{{0.6}, kAbove, {}};
    const KeptComponents kept = keep_components(scan, settings, {3, 0});
    ASSERT_NE(kept.levels[0].shared, nullptr);
    const auto domain = make_kept_level_sets(scan, settings, kept, 0).domain;
    const auto grid = padded_grid(scan, std::get<const float*>(scan.voxels), {0.6, kAbove, {}});
    const auto copy = padded_grid(scan, std::get<const float*>(kept.levels[0].scan.voxels), {0.6, kAbove, {}});
    for (int n = 0; n < 20000; ++n) {
      const Vec p = random_index(size, random);
      const CellIndex cell = cell_of(p, size);
      bool expected = trilinear(grid.corners(cell[0], cell[1], cell[2]), local_in(cell, p)) > 0;
      if (expected) {
        std::array<int, 3> order{0, 1, 2};
        std::shuffle(order.begin(), order.end(), random);
        const std::array<int, 3> node = node_reached(grid, p, order);
        ASSERT_GT(grid.height(node[0], node[1], node[2]), 0);
        expected = copy.height(node[0], node[1], node[2]) > 0;
        left_out += !expected;
        shared += kept.levels[0].shared->find(cell) != nullptr;
      }
      ASSERT_EQ(domain->region_at(p), Region{expected}) << seed << ", " << p.x << " " << p.y << " " << p.z;
    }
  }
  EXPECT_GT(shared, 1000U);
  EXPECT_GT(left_out, 300U);
}

TEST(KeptComponents, HaveTheirBoundaryOnTheLevelAsRead) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Scan scan = seed % 2 == 0 ? plateaus<std::uint8_t>({15, 14, 13}, frames()[seed % 5].frame, seed)
                                    : noisy_ball<float>({15, 14, 13}, frames()[seed % 5].frame, seed);
    const NestedLevelSettings settings{seed % 2 == 0 ? std::vector{2.0} : std::vector{70.0, 85.0}, kAbove, {}};
    const auto as_read = make_nested_level_sets(scan, settings);
    const auto domain = kept_domain(scan, settings, {2, 0});
    std::size_t points = 0;
    double worst = 0;
    double worst_told = 0;
    const auto take = [&](const Point& p) {
      ++points;
      worst = std::max(worst, as_read->residual_at(p).value());
      worst_told = std::max(worst_told, domain->residual_at(p).value());
    };
    domain->surface_candidates(0.3 * scan.frame.min_spacing_mm(), take);
    std::mt19937 random(seed);
    Crossings crossings;
    for (int n = 0; n < 2000; ++n) {
      const auto point = [&] { return scan.frame.to_world(random_index(scan.size, random)); };
      domain->crossings({point(), point()}, crossings);
      for (const Crossing& crossing : crossings) take(crossing.point);
    }
    EXPECT_GT(points, 3000U);
    EXPECT_LE(worst, 1e-9) << seed;
    EXPECT_LE(worst_told, 1e-9) << seed;
  }
}

/// The first components of the scan are those of the scan kept, node for node, and there is no other.
void expect_first_kept(const Scan& scan, const NestedLevelSettings& settings, std::uint64_t count) {
  const auto inside = [&](const Domain& domain) {
    std::vector<Component> components = domain.components();
    std::erase_if(components, [](const Component& c) { return c.region == kOutside; });
    return components;
  };
  const std::vector<Component> before = inside(*make_nested_level_sets(scan, settings));
  ASSERT_GT(before.size(), count) << "nothing to drop";
  const KeptComponents kept = keep_components(scan, settings, {count, 0});
  const std::vector<Component> after = inside(*make_kept_level_sets(scan, settings, kept, 0).domain);
  ASSERT_EQ(after.size(), count);
  ASSERT_EQ(kept.dropped.components.size(), before.size() - count);
  for (std::size_t n = 0; n < count; ++n) {
    EXPECT_EQ(after[n].witness, before[n].witness);
    EXPECT_EQ(after[n].volume_mm3, before[n].volume_mm3);
    EXPECT_EQ(after[n].box_mm.min, before[n].box_mm.min);
    EXPECT_EQ(after[n].box_mm.max, before[n].box_mm.max);
    const bool ties = !std::holds_alternative<const float*>(scan.voxels);  // nodes at the level may be told otherwise
    if (!ties && after[n].euler && before[n].euler) {
      EXPECT_EQ(*after[n].euler, *before[n].euler);
    }
  }
}

TEST(KeptComponents, ComeThroughInOnePieceInNoise) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(0, 1);
    const auto noise = [&](int, int, int) { return value(random); };
    const Frame frame = frames()[seed % 5].frame;
    const double level = 0.55 + 0.05 * (seed % 4);  // a percolating network, islands alone, and between
    for (const std::uint64_t count : {1, 2, 5, 12}) {
      const Scan floats = scan_of_function<float>({19, 18, 17}, noise, frame);
      expect_first_kept(floats, {{level}, kAbove, {}}, count);
      expect_first_kept(floats, {{1 - level}, kBelow, {}}, count);
      expect_first_kept(scan_of_function<double>({17, 19, 18}, noise, frame), {{level}, kAbove, {}}, count);
    }
  }
}

TEST(KeptComponents, ComeThroughInOnePieceWhereNodesAreAtTheLevel) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    std::mt19937 random(seed);
    std::discrete_distribution<int> rare_high({50, 25, 15, 10});
    const auto noise = [&](int, int, int) { return rare_high(random); };
    for (const std::uint64_t count : {1, 3, 7}) {
      const Scan bytes = scan_of_function<std::uint8_t>({17, 18, 19}, noise);
      expect_first_kept(bytes, {{1}, kAbove, {}}, count);
      expect_first_kept(bytes, {{1.5}, kAbove, {}}, count);
      const Scan dark =
          scan_of_function<std::int16_t>({17, 18, 19}, [&](int i, int j, int k) { return -noise(i, j, k); });
      expect_first_kept(dark, {{-1}, kBelow, {}}, count);
    }
  }
}

TEST(KeptComponents, AtALevelThatIsTheLeastValue) {
  const Scan scan = scan_of_function<std::uint8_t>(
      {9, 5, 5}, [](int i, int j, int k) { return (i == 2 || i == 3 || i == 6) && j == 2 && k == 2 ? 7 : 0; });
  const NestedLevelSettings settings{{0}, kAbove, {}};
  const KeptComponents kept = keep_components(scan, settings, {1, 0});
  EXPECT_EQ(value_at(kept.levels[0].scan, 6, 2, 2), 0) << "the type has no value below";
  EXPECT_EQ(kept_counts(scan, settings, {1, 0}), (Counts{1, 0}));
}

TEST(KeptComponents, NothingLeftIsRefusedWithTheLargestVolume) {
  try {
    keep_components(cubes(), {{20}, kAbove, {}}, {{}, 27.5});
    FAIL() << "none is so large";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), "input.components");
    EXPECT_EQ(error.fault(), Fault::input);
    const std::string text = error.what();
    EXPECT_NE(text.find("27.5"), std::string::npos) << text;
    EXPECT_NE(text.find("the largest of the 4 components has 27 mm^3"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace scantet
