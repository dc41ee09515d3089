// What is filled, counted again on the scan that comes out, and asked point by point.
#include <gtest/gtest.h>

#include "scantet/field/padded_grid.h"
#include "scantet/image/kept_components.h"
#include "unit/image/node_reached.h"
#include "unit/image/parts_of_samples.h"
#include "unit/image/sides.h"
#include "unit/image/test_scan.h"

namespace scantet {
namespace {

using namespace test;

ComponentChoice filling(double volume_mm3) {
  return {{}, 0, volume_mm3};
}

std::vector<Component> parts_of(const Domain& domain, bool inside) {
  std::vector<Component> parts = domain.components();
  std::erase_if(parts, [&](const Component& c) { return (c.region == kOutside) == inside; });
  return parts;
}

struct Made {
  KeptComponents kept;
  std::unique_ptr<Domain> domain;
};

Made made_of(const Scan& scan, const NestedLevelSettings& settings, const ComponentChoice& choice) {
  Made made{keep_components(scan, settings, choice), nullptr};
  made.domain = make_kept_level_sets(scan, settings, made.kept, 0).domain;
  return made;
}

/// 10 inside of a hollow ball with an island in its cavity of 65 mm³, and within a smaller hollow ball with a cavity of
/// one voxel; -10 elsewhere.
Scan hollows() {
  return scan_of_function<std::int16_t>({33, 17, 17}, [](int i, int j, int k) {
    const double r = distance({8, 8, 8}, {double(i), double(j), double(k)});
    const double other = distance({24, 7, 7}, {double(i), double(j), double(k)});
    return r < 1.5 || (r > 4.2 && r < 6.6) || (other > 0.5 && other < 4) ? 10 : -10;
  });
}

TEST(FilledCavities, AreThoseBelowTheVolume) {
  const NestedLevelSettings settings{{0}, kAbove, {}};
  const auto before = make_nested_level_sets(hollows(), settings);
  ASSERT_EQ(parts_of(*before, true).size(), 3U);
  const std::vector<Component> cavities = parts_of(*before, false);
  ASSERT_EQ(cavities.size(), 2U);
  ASSERT_EQ(cavities[1].volume_mm3, 1);

  EXPECT_EQ(made_of(hollows(), settings, filling(1)).kept.filled.count, 0U);
  const Made one = made_of(hollows(), settings, filling(2));
  EXPECT_EQ(one.kept.filled.count, 1U);
  EXPECT_EQ(one.kept.filled.volume_mm3, 1);
  EXPECT_EQ(parts_of(*one.domain, false).size(), 1U);
  EXPECT_EQ(parts_of(*one.domain, true).size(), 3U);
  EXPECT_EQ(before->region_at({24, 7, 7}), kOutside);
  EXPECT_EQ(one.domain->region_at({24, 7, 7}), 1);
  Crossings crossings;
  one.domain->crossings({{24, 7, 7}, {24, 7, 16}}, crossings);
  EXPECT_EQ(crossings.size(), 1U);

  const Made both = made_of(hollows(), settings, filling(1e9));
  EXPECT_EQ(both.kept.filled.count, 2U);
  EXPECT_EQ(both.kept.filled.largest_mm3, cavities[0].volume_mm3);
  EXPECT_EQ(parts_of(*both.domain, false).size(), 0U);
  const std::vector<Component> solid = parts_of(*both.domain, true);
  ASSERT_EQ(solid.size(), 2U) << "the island is part of what is around it";
  for (const Component& ball : solid) EXPECT_EQ(ball.euler, 2);
  EXPECT_EQ(solid[0].volume_mm3,
            parts_of(*before, true)[0].volume_mm3 + parts_of(*before, true)[2].volume_mm3 + cavities[0].volume_mm3);
}

TEST(FilledCavities, ComeAfterComponentsThatAreLeftOut) {
  const NestedLevelSettings settings{{0}, kAbove, {}};
  const double cavity = parts_of(*make_nested_level_sets(hollows(), settings), false)[0].volume_mm3;
  const double island = parts_of(*make_nested_level_sets(hollows(), settings), true)[2].volume_mm3;
  const auto cavities_left = [&](double volume) {
    const Made made = made_of(hollows(), settings, {{}, island + 1, volume});
    EXPECT_EQ(made.kept.dropped.components.size(), 1U);
    return parts_of(*made.domain, false).size();
  };
  EXPECT_EQ(cavities_left(cavity + island), 1U) << "without its island the cavity is that much larger";
  EXPECT_EQ(cavities_left(cavity + island + 1), 0U);
}

TEST(FilledCavities, OfSeveralLevelsStayInsideEachOther) {
  // A block of 100 with a pit of 50, in which there is one of 0.
  const Scan scan = scan_of_function<std::uint8_t>({16, 16, 16}, [](int i, int j, int k) {
    const int out = std::max({std::abs(i - 8), std::abs(j - 8), std::abs(k - 8)});
    return out > 6 || out < 1 ? 0 : out < 3 ? 50 : 100;
  });
  const NestedLevelSettings settings{{25, 75}, kAbove, {}};
  const auto regions = [&](double volume) {
    const Made made = made_of(scan, settings, filling(volume));
    return std::array{made.domain->region_at({8, 8, 8}), made.domain->region_at({8, 8, 10}),
                      made.domain->region_at({8, 8, 12}), made.domain->region_at({8, 8, 15.9})};
  };
  EXPECT_EQ(regions(1), (std::array<Region, 4>{0, 1, 2, 0}));
  EXPECT_EQ(regions(2), (std::array<Region, 4>{1, 1, 2, 0}));
  EXPECT_EQ(regions(1000), (std::array<Region, 4>{2, 2, 2, 0}));
}

TEST(FilledCavities, AreThePointsOfTheFieldThatDescendToThem) {
  std::size_t filled_points = 0;
  std::size_t shared = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(0, 1);
    const std::array<int, 3> size{13, 12, 11};
    const Scan scan = scan_of_function<float>(size, [&](int, int, int) { return value(random); });
    const NestedLevelSettings settings{{0.25}, kAbove, {}};
    const Made made = made_of(scan, settings, {3, 0, seed % 2 == 0 ? 4.0 : 1e9});
    const auto grid = padded_grid(scan, std::get<const float*>(scan.voxels), {0.25, kAbove, {}});
    const auto copy = padded_grid(made.kept.levels[0].scan, std::get<const float*>(made.kept.levels[0].scan.voxels),
                                  {0.25, kAbove, {}});
    Crossings crossings;
    Point last{-5, -5, -5};
    for (int n = 0; n < 20000; ++n) {
      std::uniform_real_distribution<double> along(-0.99, 12.9);
      const Vec p{std::min(along(random), 12.9), std::min(along(random), 11.9), std::min(along(random), 10.9)};
      const CellIndex cell = cell_of(p, size);
      const bool above = trilinear(grid.corners(cell[0], cell[1], cell[2]), local_in(cell, p)) > 0;
      const std::array<int, 3> node = node_reached(grid, p, {1, 2, 0}, above ? 1 : -1);
      const bool expected = copy.height(node[0], node[1], node[2]) > 0;
      filled_points += expected && !above ? 1U : 0U;
      if (made.kept.levels[0].shared != nullptr) shared += made.kept.levels[0].shared->find(cell) != nullptr ? 1U : 0U;
      ASSERT_EQ(made.domain->region_at(p), Region{expected}) << seed << ", " << p.x << " " << p.y << " " << p.z;
      made.domain->crossings({last, p}, crossings);
      ASSERT_EQ(crossings.size() % 2 == 1, made.domain->region_at(last) != made.domain->region_at(p));
      for (const Crossing& crossing : crossings) ASSERT_LE(made.domain->residual_at(crossing.point).value(), 1e-9);
      last = p;
    }
  }
  EXPECT_GT(filled_points, 300U);
  EXPECT_GT(shared, 1000U);
}

/// What is left after filling: the cavities that are kept, node for node, and no other.
void expect_others_kept(const Scan& scan, const NestedLevelSettings& settings, double volume) {
  const auto before = make_nested_level_sets(scan, settings);
  std::vector<Component> expected = parts_of(*before, false);
  std::erase_if(expected, [&](const Component& c) { return c.volume_mm3 < volume; });
  const Made made = made_of(scan, settings, filling(volume));
  const std::vector<Component> left = parts_of(*made.domain, false);
  ASSERT_EQ(left.size(), expected.size());
  for (std::size_t n = 0; n < left.size(); ++n) {
    EXPECT_EQ(left[n].witness, expected[n].witness);
    EXPECT_EQ(left[n].volume_mm3, expected[n].volume_mm3);
    if (left[n].euler && expected[n].euler) {
      EXPECT_EQ(*left[n].euler, *expected[n].euler);
    }
  }
  for (const Component& c : parts_of(*made.domain, true)) EXPECT_EQ(made.domain->region_at(c.witness), 1);
}

TEST(FilledCavities, LeaveTheOthersAsTheyAreInNoise) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(0, 1);
    const auto noise = [&](int, int, int) { return value(random); };
    const Frame frame = frames()[seed % 5].frame;
    const double voxel = std::abs(frame.determinant_mm3());
    const double level = 0.25 + 0.05 * (seed % 4);
    for (const double count : {1.5, 3.5, 1e6}) {
      expect_others_kept(scan_of_function<float>({19, 18, 17}, noise, frame), {{level}, kAbove, {}}, count * voxel);
      expect_others_kept(scan_of_function<double>({17, 19, 18}, noise, frame), {{1 - level}, kBelow, {}},
                         count * voxel);
    }
  }
}

TEST(FilledCavities, LeaveTheOthersAsTheyAreWhereNodesAreAtTheLevel) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    std::mt19937 random(seed);
    std::discrete_distribution<int> rare_low({10, 15, 25, 50});
    const auto noise = [&](int, int, int) { return rare_low(random); };
    for (const double volume : {1.5, 3.5, 1e6}) {
      const Scan bytes = scan_of_function<std::uint8_t>({17, 18, 19}, noise);
      expect_others_kept(bytes, {{1}, kAbove, {}}, volume);
      expect_others_kept(bytes, {{0.5}, kAbove, {}}, volume);
      expect_others_kept(bytes, {{2}, kAbove, {}}, volume);
    }
  }
}

}  // namespace
}  // namespace scantet
