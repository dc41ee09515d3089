// Components and boundaries of shapes with a known answer, and of noise, where the answers must agree with each other.
#include "scantet/topology/level_topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <tuple>

#include "scantet/base/parallel.h"
#include "scantet/field/padded_grid.h"
#include "unit/image/parts_of_samples.h"
#include "unit/image/sampled_flood.h"
#include "unit/image/test_scan.h"

namespace scantet {
namespace {

using Sides = std::array<ComponentId, 2>;  // what meets on the level set

using namespace test;

/// A scan of 30 minus the distance to the nearest of some centres: balls of radius r inside level 30 - r.
Scan balls(const Size& size, const std::vector<Vec>& centers, const Frame& frame = {}) {
  return scan_of_function<float>(
      size,
      [&](int i, int j, int k) {
        double nearest = 1e9;
        for (const Vec& c : centers) nearest = std::min(nearest, distance(c, {double(i), double(j), double(k)}));
        return 30 - nearest;
      },
      frame);
}

Scan noise(const Size& size, unsigned seed, const Frame& frame = {}) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(0, 1);
  return scan_of_function<float>(
      size, [&](int, int, int) { return value(random); }, frame);
}

/// The boundary components that the edges of the padded grid cross, in voxel units. lift: height, a little inside the
/// level, of the points that stand for the crossings: 0, or less than any height that occurs.
template <class Voxel>
std::set<Sides> boundaries_on_edges(const Scan& scan, const LevelSetSettings& settings, const LevelTopology& topology,
                                    double lift) {
  const PaddedGrid<Voxel> grid = padded_grid(scan, std::get<const Voxel*>(scan.voxels), settings);
  std::set<Sides> ids;
  for (int k = -1; k <= scan.size[2]; ++k) {
    for (int j = -1; j <= scan.size[1]; ++j) {
      for (int i = -1; i <= scan.size[0]; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
          Size next{i, j, k};
          if (++next[axis] > scan.size[axis]) continue;
          const double a = grid.height(i, j, k);
          const double b = grid.height(next[0], next[1], next[2]);
          if ((a > 0) == (b > 0)) continue;
          Vec p{double(i), double(j), double(k)};
          p[axis] += (a - lift) / (a - b);
          ids.insert(topology.components_at(p));
        }
      }
    }
  }
  return ids;
}

TEST(LevelTopology, TwoSpheres) {
  for (const auto& [name, frame] : frames()) {
    SCOPED_TRACE(name);
    const LevelTopology topology(balls({40, 24, 24}, {{10, 11.5, 11.5}, {28, 11.5, 12}}, frame), {22.5, {}, {}});
    ASSERT_EQ(counts(topology), (Counts{2, 0}));
    for (const Component& component : topology.components()) {
      const double ball = 4.0 / 3 * std::numbers::pi * std::pow(7.5, 3) * std::abs(frame.determinant_mm3());
      EXPECT_NEAR(component.volume_mm3, ball, 0.03 * ball);
      EXPECT_TRUE(component.box_mm.contains(component.witness));
      EXPECT_FALSE(component.touches_border);
    }
    const Vec first = frame.to_index(topology.components()[0].witness);
    const Vec second = frame.to_index(topology.components()[1].witness);
    EXPECT_NEAR(std::abs(first.x - second.x), 18, 1.01);
    const Sides left = topology.components_at({2.5, 11.5, 11.5});
    EXPECT_EQ(left, topology.components_at({17.5, 11.5, 11.5}));
    EXPECT_EQ(left, topology.components_at({10, 4, 11.5}));
    EXPECT_NE(left, topology.components_at({20.5, 11.5, 12}));
  }
}

TEST(LevelTopology, ShellHasOneCavity) {
  const auto shell = [](int i, int j, int k) {
    return 5 - std::abs(distance({12, 12, 12}, {i + 0.3, j + 0.1, k + 0.2}) - 8);
  };
  const LevelTopology topology(scan_of_function<float>({26, 26, 26}, shell), {2, {}, {}});
  ASSERT_EQ(counts(topology), (Counts{1, 1}));
  EXPECT_EQ(topology.components()[0].region, 1);
  EXPECT_EQ(topology.components()[1].region, kOutside);
  const double cavity = 4.0 / 3 * std::numbers::pi * 125;
  EXPECT_NEAR(topology.components()[1].volume_mm3, cavity, 0.05 * cavity);
  EXPECT_LT(distance(topology.components()[1].witness, {11.7, 11.9, 11.8}), 1);
  EXPECT_EQ(topology.components_at({6.7, 11.9, 11.8}), topology.components_at({16.7, 11.9, 11.8}));
  EXPECT_EQ(topology.components_at({0.7, 11.9, 11.8}), topology.components_at({22.7, 11.9, 11.8}));
  EXPECT_NE(topology.components_at({0.7, 11.9, 11.8}), topology.components_at({6.7, 11.9, 11.8}));
}

TEST(LevelTopology, TorusHasOneComponentAndNoCavity) {
  const auto torus = [](int i, int j, int k) { return 5 - std::hypot(std::hypot(i - 16.2, j - 16.1) - 10, k - 8.3); };
  const LevelTopology topology(scan_of_function<double>({33, 33, 17}, torus), {1, {}, {}});
  EXPECT_EQ(counts(topology), (Counts{1, 0}));
}

TEST(LevelTopology, TwoHundredIslandsEachWithAPlaceOfItsOwn) {
  const Size size{41, 33, 33};
  std::mt19937 random(3);
  std::vector<std::int16_t> values(size[0] * size[1] * size[2], -1000);
  for (int n = 0; n < 200; ++n) {  // 10 × 5 × 4 blocks of 4 × 6 × 8 voxels, an island of 1 … 3 voxels in each
    const Size low{4 * (n % 10), 6 * (n / 10 % 5), 8 * (n / 50)};
    const int length = std::uniform_int_distribution<int>(1, 3)(random);
    for (int i = 0; i < length; ++i) values[((low[2] + 3) * size[1] + low[1] + 2) * size[0] + low[0] + i] = 1000;
  }
  for (const auto& [name, frame] : frames()) {
    SCOPED_TRACE(name);
    const LevelTopology topology(scan_of(size, values, frame), {0, {}, {}});
    ASSERT_EQ(counts(topology), (Counts{200, 0}));
    const std::vector<SizeHint> features = topology.size_hints();
    const double half_mm = 0.5 * frame.min_spacing_mm();
    for (const Component& component : topology.components()) {
      const auto mine = std::count_if(features.begin(), features.end(), [&, half_mm](const SizeHint& feature) {
        return distance(feature.point, component.witness) < 1e-9 * length(component.witness) &&
               std::abs(feature.radius_mm - half_mm) < half_mm;
      });
      EXPECT_EQ(mine, 1);
    }
    EXPECT_EQ(boundaries_on_edges<std::int16_t>(scan_of(size, values, frame), {0, {}, {}}, topology, 0).size(), 200U);
  }
}

// Two nodes at the ends of a cell's body diagonal: on it the height is least in the middle, (p - 3q) / 4.
TEST(LevelTopology, TunnelThroughTheBodyOfACellJoins) {
  const auto pair = [](double sign, double q) {
    return scan_of_function<double>(
        {8, 8, 8}, [=](int i, int j, int k) { return sign * (i == j && j == k && (i == 3 || i == 4) ? 1 : -q); });
  };
  const auto count = [&](double sign, double q) {
    return counts(LevelTopology(pair(sign, q), {0, InsideSide::above, -1.0}));
  };
  EXPECT_EQ(count(1, 0.3), (Counts{1, 0}));
  EXPECT_EQ(count(1, 0.4), (Counts{2, 0}));
  EXPECT_EQ(count(-1, 0.3), (Counts{1, 1}));
  EXPECT_EQ(count(-1, 0.4), (Counts{1, 2}));
}

// Closed surfaces part space like the edges of a tree part its nodes: one boundary fewer than there are parts. Inside,
// outside and components_at() can only fit that if all joins are right.
TEST(LevelTopology, NoiseHasAsManyBoundariesAsInsideComponentsAndCavities) {
  unsigned seed = 0;
  int cavities = 0;
  for (const Size& size : {Size{6, 5, 4}, Size{12, 11, 13}, Size{67, 5, 6}}) {
    for (double level : {0.2, 0.35, 0.5, 0.65, 0.8}) {
      for (InsideSide side : {InsideSide::above, InsideSide::below}) {
        for (int repeat = 0; repeat < 10; ++repeat) {
          ++seed;
          SCOPED_TRACE(testing::Message() << "seed " << seed << ", level " << level);
          const Scan scan = noise(size, seed, frames()[seed % 5].frame);
          const LevelSetSettings settings{level, side, {}};
          const LevelTopology topology(scan, settings);
          const Counts found = counts(topology);
          cavities += found.cavities;
          ASSERT_EQ(boundaries_on_edges<float>(scan, settings, topology, 0).size(),
                    static_cast<std::size_t>(found.inside + found.cavities));
        }
      }
    }
  }
  EXPECT_GT(cavities, 1000);
}

// A flood fill of samples misses thin joins but makes none that is not there; where it finds as few parts as there are,
// its labels are right, and components_at() must tell the same pairs of them apart at every point.
TEST(LevelTopology, CountsAndBoundariesAreThoseOfAFloodFillOfFineSamples) {
  int equal = 0;
  const int repeats = 40;
  for (unsigned seed = 0; seed < repeats; ++seed) {
    SCOPED_TRACE(seed);
    const Scan scan = noise({6, 5, 4}, 1000 + seed);
    const LevelSetSettings settings{0.3 + 0.4 * seed / repeats, {}, {}};
    const LevelTopology topology(scan, settings);
    const SampledFlood flood(scan, settings, 8);
    ASSERT_LE(counts(topology).inside, flood.counts().inside);
    ASSERT_LE(counts(topology).cavities, flood.counts().cavities);
    if (counts(topology) != flood.counts()) continue;
    ++equal;
    std::set<Sides> ids;
    std::set<std::pair<int, int>> sides;
    std::set<std::pair<Sides, std::pair<int, int>>> both;
    flood.crossings([&](const Vec& point, int inside, int outside) {
      const Sides id = topology.components_at(point);
      ids.insert(id);
      sides.insert({inside, outside});
      both.insert({id, {inside, outside}});
    });
    EXPECT_EQ(ids.size(), both.size());
    EXPECT_EQ(sides.size(), both.size());
  }
  EXPECT_GE(equal, 0.7 * repeats);
}

TEST(LevelTopology, NegatedValuesAndTurnedAxesChangeNothing) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    const Size size{9, 11, 7};
    const Scan scan = noise(size, 500 + seed);
    const float* v = std::get<const float*>(scan.voxels);
    const auto at = [&](int i, int j, int k) { return v[(k * size[1] + j) * size[0] + i]; };
    const Counts found = counts(LevelTopology(scan, {0.5, InsideSide::above, {}}));
    const Scan negated = scan_of_function<float>(size, [&](int i, int j, int k) { return -at(i, j, k); });
    EXPECT_EQ(found, counts(LevelTopology(negated, {-0.5, InsideSide::below, {}})));
    const Scan turned =
        scan_of_function<float>({size[2], size[0], size[1]}, [&](int i, int j, int k) { return at(j, k, i); });
    EXPECT_EQ(found, counts(LevelTopology(turned, {0.5, InsideSide::above, {}})));
    const Scan mirrored = scan_of_function<float>(size, [&](int i, int j, int k) { return at(size[0] - 1 - i, j, k); });
    EXPECT_EQ(found, counts(LevelTopology(mirrored, {0.5, InsideSide::above, {}})));
  }
}

/// Along z the scan is cut in slabs; with its axes turned it is not.
TEST(LevelTopology, SlabsAreSewnTogether) {
  for (const double level : {0.3, 0.5, 0.7}) {
    const Size size{11, 9, 100};
    const Scan scan = noise(size, 91);
    const float* v = std::get<const float*>(scan.voxels);
    const auto at = [&](int i, int j, int k) { return v[(k * size[1] + j) * size[0] + i]; };
    const Scan turned = scan_of_function<float>({100, 11, 9}, [&](int i, int j, int k) { return at(j, k, i); });
    const LevelSetSettings settings{level, {}, {}};
    const LevelTopology topology(scan, settings);
    const LevelTopology in_one(turned, settings);
    using Row = std::tuple<Region, double, double, double, double, bool>;  // no two heights are equal
    const auto table = [](const LevelTopology& of, int x, int y, int z) {
      std::set<Row> rows;
      for (const Component& c : of.components()) {
        rows.insert({c.region, c.volume_mm3, c.witness[x], c.witness[y], c.witness[z], c.touches_border});
      }
      return rows;
    };
    EXPECT_EQ(table(topology, 0, 1, 2), table(in_one, 1, 2, 0));
    EXPECT_GT(topology.components().size(), 20U);
    EXPECT_EQ(boundaries_on_edges<float>(scan, settings, topology, 1e-9).size(),
              boundaries_on_edges<float>(turned, settings, in_one, 1e-9).size());
  }
}

TEST(LevelTopology, TheSameForAnyNumberOfThreads) {
  const Scan scan = noise({20, 31, 90}, 78);
  const auto answers = [&](std::size_t threads) {
    std::vector<double> numbers;
    with_threads(threads, [&] {
      const LevelTopology topology(scan, {0.45, {}, {}});
      for (const Component& c : topology.components()) {
        numbers.insert(numbers.end(), {c.witness.x, c.witness.y, c.witness.z, c.volume_mm3, c.box_mm.min.z});
      }
      for (const SizeHint& f : topology.size_hints()) {
        numbers.insert(numbers.end(), {f.point.x, f.point.y, f.point.z, f.radius_mm});
      }
    });
    return numbers;
  };
  const std::vector<double> alone = answers(1);
  ASSERT_GT(alone.size(), 1000U);
  for (const std::size_t threads : {2, 3, 8}) EXPECT_EQ(answers(threads), alone);
}

TEST(LevelTopology, BoundaryOfPointsThatRoundingMovedIntoTheNextCell) {
  const LevelTopology topology(balls({20, 20, 20}, {{5, 5, 5}, {14, 14, 14}}), {27, {}, {}});  // poles at nodes
  for (const Vec& center : {Vec{5, 5, 5}, Vec{14, 14, 14}}) {
    const Sides id = topology.components_at(center + Vec{3, 0, 0});
    for (double off : {-1e-9, 0.0, 1e-9}) {
      for (int axis = 0; axis < 3; ++axis) {
        for (double side : {-3.0, 3.0}) {
          Vec p = center + Vec{off, -off, off};
          p[axis] = center[axis] + side + off;
          EXPECT_EQ(topology.components_at(p), id);
        }
      }
    }
  }
}

TEST(LevelTopology, ComponentsComeLargestFirstAndTheSameEachTime) {
  const Scan scan = noise({20, 21, 22}, 77);
  for (double level : {0.25, 0.75}) {
    const LevelTopology first(scan, {level, {}, {}});
    const LevelTopology second(scan, {level, {}, {}});
    const std::vector<Component>& list = first.components();
    ASSERT_GT(list.size(), 10U);
    for (std::size_t n = 1; n < list.size(); ++n) {
      EXPECT_GE(list[n - 1].region, list[n].region);
      if (list[n - 1].region != list[n].region) continue;
      EXPECT_GE(list[n - 1].volume_mm3, list[n].volume_mm3);
      if (list[n - 1].volume_mm3 > list[n].volume_mm3) continue;
      EXPECT_TRUE(lexicographically_less(list[n - 1].witness, list[n].witness));
    }
    for (std::size_t n = 0; n < list.size(); ++n) {
      EXPECT_EQ(list[n].witness, second.components()[n].witness);
      EXPECT_EQ(list[n].volume_mm3, second.components()[n].volume_mm3);
    }
    const std::vector<SizeHint> places = first.size_hints();
    const std::vector<SizeHint> again = second.size_hints();
    ASSERT_EQ(places.size(), again.size());
    for (std::size_t n = 0; n < places.size(); ++n) {
      EXPECT_EQ(places[n].point, again[n].point);
      EXPECT_EQ(places[n].radius_mm, again[n].radius_mm);
    }
  }
}

TEST(LevelTopology, WitnessVolumeAndBorder) {
  std::vector<std::int8_t> values(7 * 6 * 5, -10);
  const auto set = [&](int i, int j, int k, int value) {
    values[(k * 6 + j) * 7 + i] = static_cast<std::int8_t>(value);
  };
  for (int i = 0; i < 3; ++i) set(i, 1, 1, 20 + i);  // reaches x = 0
  set(4, 3, 2, 30);
  set(5, 3, 2, 5);
  const Frame frame = frames()[4].frame;
  for (double sign : {1.0, -1.0}) {
    std::vector<std::int8_t> mirrored = values;
    for (std::int8_t& value : mirrored) value = static_cast<std::int8_t>(sign * value);
    const LevelTopology topology(scan_of({7, 6, 5}, mirrored, frame),
                                 {0, sign > 0 ? InsideSide::above : InsideSide::below, {}});
    ASSERT_EQ(counts(topology), (Counts{2, 0}));
    const Component& large = topology.components()[0];
    const Component& small = topology.components()[1];
    EXPECT_LT(distance(large.witness, frame.to_world({2, 1, 1})), 1e-9);
    EXPECT_LT(distance(small.witness, frame.to_world({4, 3, 2})), 1e-9);
    EXPECT_NEAR(large.volume_mm3, 3 * std::abs(frame.determinant_mm3()), 1e-9);
    EXPECT_NEAR(small.volume_mm3, 2 * std::abs(frame.determinant_mm3()), 1e-9);
    EXPECT_TRUE(large.touches_border);
    EXPECT_FALSE(small.touches_border);
    EXPECT_TRUE(large.box_mm.contains(large.box_mm.center()));
    EXPECT_NEAR(distance(small.box_mm.center(), frame.to_world({4.5, 3, 2})), 0, 1e-9);
  }
}

TEST(LevelTopology, EveryVoxelTypeGivesTheSame) {
  std::mt19937 random(5);
  std::vector<int> values(8 * 9 * 7);
  for (int& value : values) value = std::uniform_int_distribution<int>(0, 100)(random);
  const auto with = [&](auto zero) {
    const Scan scan = scan_of<decltype(zero)>({8, 9, 7}, {values.begin(), values.end()});
    return counts(LevelTopology(scan, {50, InsideSide::above, {}}));
  };
  const Counts expected = with(double{});
  EXPECT_EQ(with(float{}), expected);
  EXPECT_EQ(with(std::int8_t{}), expected);
  EXPECT_EQ(with(std::uint8_t{}), expected);
  EXPECT_EQ(with(std::int16_t{}), expected);
  EXPECT_EQ(with(std::uint16_t{}), expected);
  EXPECT_EQ(with(std::int32_t{}), expected);
  EXPECT_EQ(with(std::uint32_t{}), expected);
  EXPECT_EQ(with(std::int64_t{}), expected);
  EXPECT_EQ(with(std::uint64_t{}), expected);
}

TEST(LevelTopology, KeepsLittleMemory) {
  const LevelTopology smooth(balls({64, 64, 64}, {{20, 20, 20}, {40, 40, 40}}), {20, {}, {}});
  EXPECT_LT(smooth.memory_bytes(), 0.03 * 64 * 64 * 64 * sizeof(float));
  // Noise is the worst a scan can be: its components are listed all the same, but nothing is kept per voxel.
  const LevelTopology rough(noise({64, 64, 64}, 1), {0.5, {}, {}});
  const double listed = static_cast<double>(rough.components().size() * sizeof(Component));
  EXPECT_LT(rough.memory_bytes() - listed, 0.03 * 64 * 64 * 64 * sizeof(float));
  EXPECT_LT(rough.memory_bytes(), 0.15 * 64 * 64 * 64 * sizeof(float));
}

}  // namespace
}  // namespace scantet
