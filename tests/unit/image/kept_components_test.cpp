// What is kept and what is dropped, counted again on the scan that comes out.
#include "scantet/image/kept_components.h"

#include <gtest/gtest.h>

#include <map>

#include "scantet/base/error.h"
#include "unit/image/parts_of_samples.h"
#include "unit/image/test_scan.h"

namespace scantet {
namespace {

using namespace test;

constexpr InsideSide kAbove = InsideSide::above;
constexpr InsideSide kBelow = InsideSide::below;

Counts counts_of(const Scan& scan, const NestedLevelSettings& settings) {
  const NestedLevelSettings checked = checked_settings(scan, settings);
  const double outermost = outermost_first(checked.levels, checked.inside).front();
  return counts(LevelTopology(scan, {outermost, checked.inside, checked.outside}));
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
    EXPECT_EQ(counts_of(kept.scan, settings), (Counts{4 - static_cast<int>(dropped.size()), 0}));
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
  EXPECT_EQ(value_at(two.scan, 7, 2, 2), 50) << "the first of the equals";
  EXPECT_EQ(value_at(two.scan, 10, 2, 2), 19) << "just outside";
  EXPECT_EQ(two.dropped.components[0].witness, (Point{10 + 0.5 * 10, 22, 34}));
}

TEST(KeptComponents, WithNothingToDropAreTheScanItself) {
  const Scan scan = cubes();
  for (const ComponentChoice& choice : {ComponentChoice{4, 0}, ComponentChoice{9, 1}, ComponentChoice{{}, 1}}) {
    const KeptComponents kept = keep_components(scan, {{20}, kAbove, {}}, choice);
    EXPECT_EQ(kept.scan.voxels, scan.voxels) << "no copy";
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
  EXPECT_EQ(counts_of(parted.scan, settings), (Counts{1, 0}));
  EXPECT_EQ(value_at(parted.scan, 3, 3, 2), 1);
  EXPECT_NEAR(value_at(parted.scan, 4, 4, 2), -0.0025, 1e-6) << "a thousandth of the range";
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
  const KeptComponents two = keep_components(nested(), settings, {2, 0});
  EXPECT_EQ(counts_of(two.scan, settings), (Counts{2, 1})) << "the cavity stays without its island";
  const KeptComponents one = keep_components(nested(), settings, {1, 0});
  EXPECT_EQ(counts_of(one.scan, settings), (Counts{1, 0})) << "the cavity of a dropped shell goes with it";
  EXPECT_GT(value_at(one.scan, 24, 7, 7), 0) << "the solid ball is the largest";
  // Turned inside out, the solid ball, the shell and the island are cavities, the last one in the shell's hollow.
  const NestedLevelSettings dark{{0}, kBelow, 10.0};
  ASSERT_EQ(counts_of(nested(), dark), (Counts{2, 3}));
  const KeptComponents around = keep_components(nested(), dark, {1, 0});
  EXPECT_EQ(counts_of(around.scan, dark), (Counts{1, 2})) << "the hollow is filled";
}

TEST(KeptComponents, OfSeveralLevelsAreThoseOfTheOutermost) {
  const auto bumps = [](double first, double second) {
    return scan_of_function<float>({24, 11, 11}, [=](int i, int j, int k) {
      const Point p{double(i), double(j), double(k)};
      return std::max({0.0, first - 10 * distance({5, 5, 5}, p), second - 10 * distance({17, 5, 5}, p)});
    });
  };
  const auto regions = [](const Domain& domain) {
    std::map<Region, int> count;
    for (const Component& component : domain.components()) ++count[component.region];
    return count;
  };
  using Regions = std::map<Region, int>;
  const NestedLevelSettings settings{{30, 10}, kAbove, {}};
  const Scan scan = bumps(52, 42);
  ASSERT_EQ(regions(*make_nested_level_sets(scan, settings)), (Regions{{1, 2}, {2, 2}}));
  const KeptComponents kept = keep_components(scan, settings, {1, 0});
  EXPECT_EQ(kept.dropped.found, 2U);
  const auto domain = make_nested_level_sets(kept.scan, settings);
  EXPECT_EQ(regions(*domain), (Regions{{1, 1}, {2, 1}})) << "what is within goes, too";
  EXPECT_EQ(domain->region_at({17, 5, 5}), kOutside);
  EXPECT_EQ(domain->region_at({5, 5, 5}), 2);

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

/// The first components of the scan are those of the scan kept, node for node, and there is no other.
void expect_first_kept(const Scan& scan, const NestedLevelSettings& settings, std::uint64_t count) {
  const auto inside = [&](const Scan& of) {
    const NestedLevelSettings checked = checked_settings(of, settings);
    std::vector<Component> components =
        LevelTopology(of, {outermost_first(checked.levels, checked.inside).front(), checked.inside, checked.outside})
            .components();
    std::erase_if(components, [](const Component& c) { return c.region == kOutside; });
    return components;
  };
  const std::vector<Component> before = inside(scan);
  ASSERT_GT(before.size(), count) << "nothing to drop";
  const KeptComponents kept = keep_components(scan, settings, {count, 0});
  const std::vector<Component> after = inside(kept.scan);
  ASSERT_EQ(after.size(), count);
  ASSERT_EQ(kept.dropped.components.size(), before.size() - count);
  for (std::size_t n = 0; n < count; ++n) {
    EXPECT_EQ(after[n].witness, before[n].witness);
    EXPECT_EQ(after[n].volume_mm3, before[n].volume_mm3);
    EXPECT_EQ(after[n].box_mm.min, before[n].box_mm.min);
    EXPECT_EQ(after[n].box_mm.max, before[n].box_mm.max);
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
      expect_first_kept(scan_of_function<double>({17, 19, 18}, noise, frame), {{level, 0.95}, kAbove, {}}, count);
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
  EXPECT_EQ(value_at(kept.scan, 6, 2, 2), 0) << "the type has no value below";
  EXPECT_EQ(counts_of(kept.scan, settings), (Counts{1, 0}));
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
