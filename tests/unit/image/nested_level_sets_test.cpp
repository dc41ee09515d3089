// Nested level sets against the single ones that they are made of, and against counts and integrals of the field.
#include "scantet/image/nested_level_sets.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "cancelled_after.h"
#include "scantet/base/error.h"
#include "scantet/base/union_find.h"
#include "unit/image/sides.h"
#include "unit/image/test_scan.h"

namespace scantet {
namespace {

using test::kAbove;
using test::kBelow;
using test::noisy_ball;
using test::plateaus;
using test::scan_of_function;

struct Case {
  Scan scan;
  NestedLevelSettings settings;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const auto& [name, frame] : test::frames()) {
    all.push_back({noisy_ball<float>({15, 14, 13}, frame), {{30, 70}, kAbove, {}}});
    all.push_back({noisy_ball<float>({12, 15, 13}, frame), {{50, 50.0002, 80}, kAbove, {}}});
    all.push_back({noisy_ball<std::int16_t>({13, 14, 15}, frame), {{70, 20, 45}, kBelow, {}}});
    all.push_back({plateaus<std::uint8_t>({11, 9, 10}, frame), {{0, 1, 2}, kAbove, {}}});
    all.push_back({plateaus<double>({9, 10, 11}, frame), {{0.5, 1, 1.0001}, kAbove, {}}});
  }
  return all;
}

std::vector<std::unique_ptr<Domain>> single_levels(const Case& c) {
  std::vector<double> levels = c.settings.levels;
  std::sort(levels.begin(), levels.end());
  if (c.settings.inside == kBelow) std::reverse(levels.begin(), levels.end());
  const auto outside = checked_settings(c.scan, {levels.front(), c.settings.inside, {}}).outside;
  std::vector<std::unique_ptr<Domain>> domains;
  for (const double level : levels) domains.push_back(make_level_set(c.scan, {level, c.settings.inside, outside}));
  return domains;
}

Segment random_segment(const Scan& scan, std::mt19937& random) {
  return {scan.frame.to_world(test::random_index(scan.size, random, -2)),
          scan.frame.to_world(test::random_index(scan.size, random, -2))};
}

TEST(NestedLevelSets, RegionsCountTheLevelsThatHaveThePointInside) {
  std::mt19937 random(1);
  for (const Case& c : cases()) {
    const auto nested = make_nested_level_sets(c.scan, c.settings);
    const auto singles = single_levels(c);
    std::set<Region> seen;
    for (int i = 0; i < 3000; ++i) {
      const Point p = c.scan.frame.to_world(test::random_index(c.scan.size, random, -2));
      Region inside = 0;
      for (const auto& single : singles) inside += single->region_at(p) != kOutside ? 1 : 0;
      EXPECT_EQ(nested->region_at(p), inside);
      seen.insert(inside);
    }
    EXPECT_GE(seen.size(), singles.size()) << "a region between levels that nearly touch may be missed";
  }
}

TEST(NestedLevelSets, CrossingsAreThoseOfTheLevelsStepByStep) {
  std::mt19937 random(2);
  Crossings crossings;
  Crossings single;
  for (const Case& c : cases()) {
    const auto nested = make_nested_level_sets(c.scan, c.settings);
    const auto singles = single_levels(c);
    for (int i = 0; i < 1500; ++i) {
      const Segment segment = random_segment(c.scan, random);
      nested->crossings(segment, crossings);
      Region region = nested->region_at(segment.source);
      double last = 0;
      std::map<Region, std::vector<Point>> of_level;  // by the region inside it
      for (const Crossing& crossing : crossings) {
        EXPECT_EQ(crossing.from, region);
        EXPECT_EQ(std::abs(crossing.to - crossing.from), 1);
        region = crossing.to;
        const double along = distance(segment.source, crossing.point);
        EXPECT_GE(along, last - 1e-9);
        last = along;
        of_level[std::max(crossing.from, crossing.to)].push_back(crossing.point);
        EXPECT_LE(*nested->residual_at(crossing.point), 1e-9);
      }
      EXPECT_EQ(region, nested->region_at(segment.target));
      for (std::size_t n = 0; n < singles.size(); ++n) {
        singles[n]->crossings(segment, single);
        const std::vector<Point>& mine = of_level[static_cast<Region>(n + 1)];
        ASSERT_EQ(mine.size(), single.size()) << "level " << n;
        for (std::size_t k = 0; k < mine.size(); ++k) EXPECT_EQ(mine[k], single[k].point);
      }
    }
  }
}

TEST(NestedLevelSets, EndsAtNodesAndOnLevelsKeepTheSteps) {
  // Nodes at a level, segments along grid lines and between crossings: where rounding has its say.
  std::mt19937 random(3);
  Crossings crossings;
  for (const Case& c : cases()) {
    const auto nested = make_nested_level_sets(c.scan, c.settings);
    std::vector<Point> ends;
    for (int i = 0; i < 40; ++i) {
      Vec index = test::random_index(c.scan.size, random, -1);
      for (int axis = 0; axis < 3; ++axis) index[axis] = std::round(index[axis]);
      if (i % 2 == 0) ends.push_back(c.scan.frame.to_world(index));
      nested->crossings(random_segment(c.scan, random), crossings);
      for (const Crossing& crossing : crossings) ends.push_back(crossing.point);
    }
    ends.resize(std::min<std::size_t>(ends.size(), 80));
    for (const Point& from : ends) {
      for (const Point& to : ends) {
        nested->crossings({from, to}, crossings);
        Region region = nested->region_at(from);
        for (const Crossing& crossing : crossings) {
          ASSERT_EQ(crossing.from, region);
          ASSERT_EQ(std::abs(crossing.to - crossing.from), 1);
          region = crossing.to;
        }
        ASSERT_EQ(region, nested->region_at(to));
      }
    }
  }
}

TEST(NestedLevelSets, BoundariesOfDifferentLevelsHaveDifferentNames) {
  std::mt19937 random(4);
  Crossings crossings;
  const Case c{noisy_ball<float>({15, 14, 13}, {}), {{30, 70}, kAbove, {}}};
  const auto nested = make_nested_level_sets(c.scan, c.settings);
  const auto singles = single_levels(c);
  std::map<Region, std::set<Patch>> names;
  for (int i = 0; i < 2000; ++i) {
    nested->crossings(random_segment(c.scan, random), crossings);
    for (const Crossing& crossing : crossings) {
      const Region level = std::max(crossing.from, crossing.to);
      names[level].insert(nested->patch_at(crossing.point));
    }
  }
  ASSERT_EQ(names.size(), 2U);
  for (const Patch id : names[1]) EXPECT_EQ(names[2].count(id), 0U);
  EXPECT_GT(names[1].size() + names[2].size(), 2U);
}

/// Components of each region among the nodes of a grid `fine` times as dense as the voxels, joined along its edges
/// where the regions of the ends agree and nothing is crossed between them.
std::map<Region, std::size_t> flooded_components(const Domain& domain, const Scan& scan, int fine) {
  std::array<int, 3> nodes{};
  for (int axis = 0; axis < 3; ++axis) nodes[axis] = fine * (scan.size[axis] + 1) + 1;
  const auto id = [&](int i, int j, int k) { return static_cast<std::uint32_t>((k * nodes[1] + j) * nodes[0] + i); };
  const auto at = [&](int i, int j, int k) {
    return scan.frame.to_world({double(i) / fine - 1, double(j) / fine - 1, double(k) / fine - 1});
  };
  UnionFind sets(static_cast<std::size_t>(nodes[0]) * nodes[1] * nodes[2]);
  std::vector<Region> regions;
  Crossings crossings;
  for (int k = 0; k < nodes[2]; ++k) {
    for (int j = 0; j < nodes[1]; ++j) {
      for (int i = 0; i < nodes[0]; ++i) {
        const Point here = at(i, j, k);
        regions.push_back(domain.region_at(here));
        const auto join = [&](int x, int y, int z) {
          if (x < 0 || y < 0 || z < 0 || regions[id(x, y, z)] != regions.back()) return;
          domain.crossings({at(x, y, z), here}, crossings);
          if (crossings.empty()) sets.unite(id(x, y, z), id(i, j, k));
        };
        join(i - 1, j, k);
        join(i, j - 1, k);
        join(i, j, k - 1);
      }
    }
  }
  std::map<Region, std::size_t> count;
  for (std::uint32_t n = 0; n < regions.size(); ++n) count[regions[n]] += sets.find(n) == n ? 1 : 0;
  return count;
}

std::map<Region, std::size_t> listed_components(const Domain& domain) {
  std::map<Region, std::size_t> count;
  for (const Component& component : domain.components()) {
    ++count[component.region];
    EXPECT_EQ(domain.region_at(component.witness), component.region);
    EXPECT_GE(component.volume_mm3, 0);
  }
  return count;
}

/// Waves that fade towards the border, gentle enough for a finer grid to see what there is: values from 0 to 100.
Scan waves(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> angle(0, 6.28);
  const Vec shift{angle(random), angle(random), angle(random)};
  return scan_of_function<float>({21, 19, 20}, [&](int i, int j, int k) {
    const double r = length(Vec{i / 10.0 - 1, j / 9.0 - 1, k / 9.5 - 1});
    const double wave = std::sin(0.7 * i + shift.x) * std::sin(0.6 * j + shift.y) + 0.5 * std::sin(0.65 * k + shift.z);
    return std::clamp(2.2 - 2 * r, 0.0, 1.0) * (50 + 30 * wave);
  });
}

// A flood misses thin joins but makes none that is not there.
TEST(NestedLevelSets, ComponentsAreThoseThatAFloodFinds) {
  std::size_t most = 0;
  int equal = 0;
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    for (const InsideSide side : {kAbove, kBelow}) {
      const Scan scan = waves(seed);
      const auto nested = make_nested_level_sets(scan, {{25, 45, 65}, side, side == kAbove ? 0.0 : 100.0});
      auto flooded = flooded_components(*nested, scan, 4);
      --flooded[kOutside];  // the unbounded one is not listed
      auto listed = listed_components(*nested);
      listed[kOutside] += 0;
      for (const auto& [region, count] : listed) {
        EXPECT_LE(count, flooded[region]) << "region " << region << ", seed " << seed;
        if (listed == flooded) most = std::max(most, count);
      }
      equal += listed == flooded ? 1 : 0;
    }
  }
  EXPECT_GE(equal, 4);
  EXPECT_GE(most, 3U) << "nothing of interest was asked";
}

TEST(NestedLevelSets, ShellsWithinShellsAreComponents) {
  // Values go up and down with the distance from the middle: 0 60 0 60 …; each maximum is a shell of its own.
  const Scan scan = scan_of_function<float>({33, 33, 33}, [](int i, int j, int k) {
    const double r = length(Vec{double(i) - 16, double(j) - 16, double(k) - 16});
    return r > 15 ? 0.0 : 30 - 30 * std::cos(0.8 * r);
  });
  const auto nested = make_nested_level_sets(scan, {{20, 40}, kAbove, {}});
  // Maxima at r = 3.9, 11.8; minima at 0, 7.9. Region 2: two shells; region 1: both sides of each.
  auto listed = listed_components(*nested);
  EXPECT_EQ(listed[2], 2U);
  EXPECT_EQ(listed[1], 4U);
  EXPECT_EQ(listed[kOutside], 2U);
  double volume = 0;
  double whole = 0;
  for (const Component& component : nested->components())
    volume += component.region != kOutside ? component.volume_mm3 : 0;
  for (const Component& component : make_level_set(scan, {20, kAbove, {}})->components()) {
    whole += component.region != kOutside ? component.volume_mm3 : 0;
  }
  EXPECT_NEAR(volume, whole, 1e-9 * whole) << "each node is in one component";
}

/// The sum over the components of a region; none if one of them is not known.
std::optional<std::int64_t> euler_of(const std::vector<Component>& components, Region region) {
  std::int64_t sum = 0;
  for (const Component& component : components) {
    if (component.region != region) continue;
    if (!component.euler) return std::nullopt;
    EXPECT_EQ(*component.euler % 2, 0);
    sum += *component.euler;
  }
  return sum;
}

// A region is bounded by its own level set and that of the next level.
TEST(NestedLevelSets, EulerNumbersAreThoseOfTheLevels) {
  int known = 0;
  for (const Case& c : cases()) {
    const auto components = make_nested_level_sets(c.scan, c.settings)->components();
    const auto singles = single_levels(c);
    for (std::size_t n = 0; n < singles.size(); ++n) {
      const auto found = euler_of(components, static_cast<Region>(n + 1));
      const auto own = euler_of(singles[n]->components(), 1);
      const auto next = n + 1 < singles.size() ? euler_of(singles[n + 1]->components(), 1) : 0;
      if (!found || !own || !next) continue;
      ++known;
      EXPECT_EQ(*found, *own + *next) << "region " << n + 1;
    }
  }
  EXPECT_GT(known, 30);
  // Shells as above, of which each region has those of two spheres.
  const auto shells =
      make_nested_level_sets(scan_of_function<float>({33, 33, 33},
                                                     [](int i, int j, int k) {
                                                       const Vec v{i - 16.1, j - 16.2, k - 15.9};
                                                       const double r = length(v);
                                                       return r > 15 ? 0.0 : 30 - 30 * std::cos(0.8 * r);
                                                     }),
                             {{20, 40}, kAbove, {}});
  for (const Component& component : shells->components()) {
    const bool ball = component.region == kOutside && component.volume_mm3 < 100;
    EXPECT_EQ(component.euler, ball ? 2 : 4) << component.region;
  }
}

TEST(NestedLevelSets, NarrowWaysOfAllLevelsLieInOneRegionEach) {
  for (const Case& c : cases()) {
    const auto nested = make_nested_level_sets(c.scan, c.settings);
    const bool are_plateaus = c.settings.levels.front() < 2;  // with nodes at a level, where ways may touch it
    std::set<Region> seen;
    Crossings crossings;
    nested->narrow_ways(LevelGround::ends_ways, [&](const NarrowWay& way) {
      EXPECT_EQ(nested->region_at(way.segment.source), way.region);
      EXPECT_EQ(nested->region_at(way.segment.target), way.region);
      nested->crossings(way.segment, crossings);
      EXPECT_TRUE(crossings.empty() || are_plateaus);
      seen.insert(way.region);
    });
    EXPECT_TRUE(seen.contains(kOutside) || are_plateaus);
    EXPECT_TRUE(seen.contains(static_cast<Region>(c.settings.levels.size()))) << "those of the inner levels are missed";
  }
}

TEST(NestedLevelSets, EachLevelLooksForMisplacedNodesInItsOwnBoundary) {
  const auto nested = make_nested_level_sets(noisy_ball<float>({15, 14, 13}, Frame{}), {{30, 70}, kAbove, {}});
  std::vector<Region> asked;
  const auto empty = [&](Region first) -> TriangleSurface {
    asked.push_back(first);
    return {};
  };
  std::set<Region> regions;
  for (const Misplaced& place : nested->misplaced(empty, {})) {
    EXPECT_EQ(place.region, nested->region_at(place.point));
    regions.insert(place.region);
  }
  EXPECT_EQ(asked, (std::vector<Region>{1, 2}));
  EXPECT_TRUE(regions.contains(2)) << "all that is inside of the inner level is missed";
}

TEST(NestedLevelSets, CavitiesWithoutVolumeAreNoComponents) {
  // One voxel at the upper level itself in the middle of higher ones: no place for region 1 there.
  const Scan scan = scan_of_function<float>({9, 9, 9}, [](int i, int j, int k) {
    if (i == 4 && j == 4 && k == 4) return 50;
    return std::max({std::abs(i - 4), std::abs(j - 4), std::abs(k - 4)}) <= 2 ? 80 : 0;
  });
  auto listed = listed_components(*make_nested_level_sets(scan, {{20, 50}, kAbove, {}}));
  EXPECT_EQ(listed[1], 1U);
  EXPECT_EQ(listed[2], 1U);
  EXPECT_EQ(listed[kOutside], 0U);
}

TEST(NestedLevelSets, MakingThemCanBeCancelled) {
  const Scan scan = noisy_ball<float>({15, 14, 83}, {});
  test::expect_cancellable(2 * 3 * 83, [&](const Progress& progress) {
    return make_nested_level_sets(scan, {{45, 55}, kAbove, {}}, progress) != nullptr;
  });
}

TEST(NestedLevelSets, OneLevelIsALevelSet) {
  const Scan scan = noisy_ball<float>({15, 14, 13}, {});
  const auto one = make_nested_level_sets(scan, {{50}, kAbove, {}});
  const auto plain = make_level_set(scan, {50, kAbove, {}});
  std::mt19937 random(5);
  for (int i = 0; i < 500; ++i) {
    const Segment segment = random_segment(scan, random);
    Crossings a;
    Crossings b;
    one->crossings(segment, a);
    plain->crossings(segment, b);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_EQ(a[k].point, b[k].point);
      EXPECT_EQ(one->patch_at(a[k].point), plain->patch_at(b[k].point));
    }
  }
}

std::string refusal(const Scan& scan, const NestedLevelSettings& settings) {
  try {
    make_nested_level_sets(scan, settings);
  } catch (const Error& error) {
    return error.code() + ": " + error.what();
  }
  return "";
}

TEST(NestedLevelSets, BadLevelsAreRefusedByName) {
  const Scan scan = noisy_ball<float>({15, 14, 13}, {});
  const auto expect = [&](const NestedLevelSettings& settings, const std::string& code, const std::string& part) {
    const std::string said = refusal(scan, settings);
    EXPECT_EQ(said.rfind(code, 0), 0U) << said;
    EXPECT_NE(said.find(part), std::string::npos) << said;
  };
  expect({{}, kAbove, {}}, "usage.level", "0 levels");
  expect({std::vector<double>(17, 1), kAbove, {}}, "usage.level", "17 levels");
  expect({{20, 60, 20}, kAbove, {}}, "usage.level", "level 20 is given twice");
  expect({{20, 20.00001}, kAbove, {}}, "usage.level", "too near");
  expect({{20, 500}, kAbove, {}}, "input.level", "level 500 leaves nothing inside");
  expect({{-5, 60}, kAbove, {}}, "input.level", "level -5 leaves nothing outside");
  expect({{-5, 60}, kBelow, {}}, "input.level", "level -5 leaves nothing inside");
  expect({{20, std::numeric_limits<double>::quiet_NaN()}, kAbove, {}}, "input.level", "not a number");
  expect({{20, 60}, kAbove, 30.0}, "usage.outside", "inside of level 20");
  EXPECT_EQ(refusal(scan, {{60, 20}, kAbove, 20.0}), "") << "moved off the level";
}

}  // namespace
}  // namespace scantet
