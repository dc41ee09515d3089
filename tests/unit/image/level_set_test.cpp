#include "scantet/image/level_set.h"

#include <gtest/gtest.h>

#include <thread>

#include "scantet/base/error.h"
#include "scantet/field/bernstein_cubic.h"
#include "scantet/field/padded_grid.h"
#include "unit/image/test_scan.h"

namespace scantet {
namespace {

using test::kSize;
using test::random_index;

constexpr double kResidual = 1e-9;  // the promise of level_set.h

double along(const Segment& s, const Point& p) {
  const Vec d = s.target - s.source;
  return dot(p - s.source, d) / std::max(squared_length(d), 1e-300);
}

/// Order, alternation, agreement with region_at at both ends, distance from the segment, residual.
void expect_sound_crossings(const Domain& domain, const Segment& s, const Crossings& crossings) {
  Region now = domain.region_at(s.source);
  double t = -1;
  for (const Crossing& crossing : crossings) {
    ASSERT_EQ(crossing.from, now);
    ASSERT_NE(crossing.to, now);
    now = crossing.to;
    const double t_here = along(s, crossing.point);
    const double rounding = 1e-9 / std::max(distance(s.source, s.target), 1e-9);
    ASSERT_GE(t_here, t - rounding);
    ASSERT_GE(t_here, -rounding);
    ASSERT_LE(t_here, 1 + rounding);
    t = t_here;
    ASSERT_LE(distance(crossing.point, lerp(s.source, s.target, t)), 1e-9);
    ASSERT_LE(domain.residual_at(crossing.point).value(), kResidual);
  }
  ASSERT_EQ(now, domain.region_at(s.target));
}

/// No sample of the segment is in another region than the crossings say, but for samples on the level to rounding.
void expect_no_missed_flip(const Domain& domain, const Segment& s, const Crossings& crossings, int samples) {
  for (int i = 0; i <= samples; ++i) {
    const double t = static_cast<double>(i) / samples;
    const Point p = lerp(s.source, s.target, t);
    Region expected = domain.region_at(s.source);
    for (const Crossing& crossing : crossings) {
      if (along(s, crossing.point) < t) expected = crossing.to;
    }
    if (domain.region_at(p) == expected || domain.residual_at(p).value() < 1e-11) continue;
    ADD_FAILURE() << "region " << domain.region_at(p) << " at " << t << ", crossings say " << expected;
    return;
  }
}

void expect_agreement(const Domain& domain, const Segment& s, int samples = 200) {
  Crossings crossings;
  domain.crossings(s, crossings);
  expect_sound_crossings(domain, s, crossings);
  expect_no_missed_flip(domain, s, crossings, samples);
}

struct NamedDomain {
  std::string name;
  Scan scan;
  std::unique_ptr<Domain> domain;
};

/// A noisy ball and an image of plateaus in every frame, inside above and below.
std::vector<NamedDomain> domains() {
  std::vector<NamedDomain> all;
  const auto add = [&](const std::string& name, const Scan& scan, const LevelSetSettings& settings) {
    all.push_back({name, scan, make_level_set(scan, settings)});
  };
  for (const auto& [name, frame] : test::frames()) {
    add(name + " ball", test::noisy_ball<float>(kSize, frame), {50, InsideSide::above, {}});
    add(name + " ball below", test::noisy_ball<std::int16_t>(kSize, frame), {50, InsideSide::below, 200.0});
    add(name + " plateaus", test::plateaus<std::uint8_t>(kSize, frame), {1, InsideSide::above, {}});
    add(name + " plateaus below", test::plateaus<std::uint8_t>(kSize, frame), {2, InsideSide::below, {}});
    add(name + " plateaus at the minimum", test::plateaus<std::uint8_t>(kSize, frame), {0, InsideSide::above, {}});
  }
  return all;
}

TEST(LevelSetCrossings, RandomSegmentsAgreeWithRegionAt) {
  std::mt19937 random(11);
  for (const auto& [name, scan, domain] : domains()) {
    SCOPED_TRACE(name);
    for (int i = 0; i < 60; ++i) {
      const Point source = scan.frame.to_world(random_index(kSize, random, -3));
      const Point target = scan.frame.to_world(random_index(kSize, random, -3));
      expect_agreement(*domain, {source, target});
      const Point close = lerp(source, target, 0.03);
      expect_agreement(*domain, {source, close}, 50);
      if (HasFailure()) return;
    }
  }
}

TEST(LevelSetCrossings, SegmentsThroughNodesAlongEdgesAndInFaces) {
  std::mt19937 random(12);
  const auto snapped = [&] {
    const Vec p = random_index(kSize, random, -2);
    return Vec{std::round(p.x), std::round(p.y), std::round(2 * p.z) / 2};
  };
  for (const auto& [name, scan, domain] : domains()) {
    SCOPED_TRACE(name);
    for (int i = 0; i < 120; ++i) {
      const Vec source = snapped();
      Vec target = snapped();
      if (i % 2 == 0) target.x = source.x;
      if (i % 3 == 0) target.y = source.y;
      if (i % 7 == 0) target = source + Vec{6, 6, -6};
      expect_agreement(*domain, {scan.frame.to_world(source), scan.frame.to_world(target)});
      if (HasFailure()) return;
    }
  }
}

TEST(LevelSetCrossings, LongSegmentsFromFarOutside) {
  std::mt19937 random(13);
  for (const auto& [name, scan, domain] : domains()) {
    SCOPED_TRACE(name);
    for (int i = 0; i < 60; ++i) {
      const Point middle = scan.frame.to_world(random_index(kSize, random));
      const Vec ray = 1e4 * test::random_direction(random);
      Crossings through;
      for (const Segment& s : {Segment{middle - ray, middle + ray}, Segment{middle, middle + ray}}) {
        domain->crossings(s, through);
        expect_sound_crossings(*domain, s, through);
        const double reach = domain->bounds().diagonal() / 2e4;
        const Segment inner{lerp(s.source, s.target, s.source == middle ? 0 : 0.5 - reach),
                            lerp(s.source, s.target, s.source == middle ? 2 * reach : 0.5 + reach)};
        expect_no_missed_flip(*domain, inner, through, 200);
        if (HasFailure()) return;
      }
      domain->crossings({middle + ray, middle + 2 * ray}, through);
      EXPECT_TRUE(through.empty());
    }
  }
}

TEST(LevelSetCrossings, ZeroLengthAndTinySegments) {
  std::mt19937 random(14);
  for (const auto& [name, scan, domain] : domains()) {
    SCOPED_TRACE(name);
    Crossings crossings;
    for (int i = 0; i < 200; ++i) {
      const Point p = scan.frame.to_world(random_index(kSize, random, -2));
      domain->crossings({p, p}, crossings);
      EXPECT_TRUE(crossings.empty());
      domain->crossings({p, p + 5 * test::random_direction(random)}, crossings);
      for (const Crossing& crossing : Crossings(crossings)) {  // ends on the surface, all but zero length
        expect_agreement(*domain, {crossing.point, crossing.point + 1e-13 * test::random_direction(random)}, 4);
        expect_agreement(*domain, {crossing.point, p}, 50);
      }
    }
  }
}

/// Every sign change of the field along the segment by going through all cells of the grid, skipping none: the cubic of
/// a cell by interpolation at four points, from heights alone.
std::vector<double> changes_in_all_cells(const PaddedGrid<float>& grid, const Vec& from, const Vec& to) {
  std::vector<double> changes;
  const auto height = [&](const std::array<double, 8>& h, const Vec& u) {
    double sum = 0;
    for (int c = 0; c < 8; ++c)
      sum += h[c] * (c & 1 ? u.x : 1 - u.x) * (c & 2 ? u.y : 1 - u.y) * (c & 4 ? u.z : 1 - u.z);
    return sum;
  };
  for (int cell = 0; cell < (grid.size[0] + 1) * (grid.size[1] + 1) * (grid.size[2] + 1); ++cell) {
    const int i = cell % (grid.size[0] + 1) - 1;
    const int j = cell / (grid.size[0] + 1) % (grid.size[1] + 1) - 1;
    const int k = cell / (grid.size[0] + 1) / (grid.size[1] + 1) - 1;
    const Vec corner{double(i), double(j), double(k)};
    double enter = 0;
    double leave = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (corner[axis] - from[axis]) / (to[axis] - from[axis]);
      const double b = (corner[axis] + 1 - from[axis]) / (to[axis] - from[axis]);
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (!(enter < leave)) continue;
    const std::array<double, 8> h = grid.corners(i, j, k);
    std::array<double, 4> f;
    for (int n = 0; n < 4; ++n) f[n] = height(h, lerp(from, to, enter + (leave - enter) * n / 3) - corner);
    const BernsteinCubic b{f[0], (-5 * f[0] + 18 * f[1] - 9 * f[2] + 2 * f[3]) / 6,
                           (2 * f[0] - 9 * f[1] + 18 * f[2] - 5 * f[3]) / 6, f[3]};
    const SignChanges found = sign_changes(b, b[0] > 0, b[3] > 0);
    for (int n = 0; n < found.count; ++n) changes.push_back(enter + (leave - enter) * found.t[n]);
  }
  std::sort(changes.begin(), changes.end());
  return changes;
}

TEST(LevelSetCrossings, SkippingBlocksMissesNothing) {
  const std::array<int, 3> size{75, 44, 38};  // more than one coarse block
  std::mt19937 random(15);
  for (const auto& [name, frame] : test::frames()) {
    SCOPED_TRACE(name);
    const Scan scan = test::noisy_ball<float>(size, frame);
    const std::unique_ptr<Domain> domain = make_level_set(scan, {50, InsideSide::above, {}});
    const PaddedGrid<float> grid = padded_grid(scan, std::get<const float*>(scan.voxels), {50, InsideSide::above, {}});
    std::size_t total = 0;
    for (int i = 0; i < 25; ++i) {
      const Segment s{frame.to_world(random_index(size, random)), frame.to_world(random_index(size, random))};
      Crossings crossings;
      domain->crossings(s, crossings);
      const std::vector<double> expected =
          changes_in_all_cells(grid, frame.to_index(s.source), frame.to_index(s.target));
      ASSERT_EQ(crossings.size(), expected.size());
      for (std::size_t n = 0; n < expected.size(); ++n) EXPECT_NEAR(along(s, crossings[n].point), expected[n], 1e-8);
      total += expected.size();
    }
    EXPECT_GT(total, 25U);
  }
}

TEST(LevelSetCrossings, OneTwoAndThreeRootsInOneCell) {
  const Scan scan =
      test::scan_of_function<double>({2, 2, 2}, [](int i, int j, int k) { return (i - 0.5) * (j - 0.5) * (k - 0.5); });
  const std::unique_ptr<Domain> domain = make_level_set(scan, {0, InsideSide::above, {}});
  const auto expect_at = [&](const Segment& s, const std::vector<double>& expected, double tolerance) {
    Crossings crossings;
    domain->crossings(s, crossings);
    ASSERT_EQ(crossings.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(along(s, crossings[i].point), expected[i], tolerance);
  };
  expect_at({{0.2, 0, 0}, {0.2, 1, 0.2}}, {0.5}, 1e-15);
  expect_at({{0.2, 0, 0}, {0.2, 1, 0.8}}, {0.5, 0.625}, 1e-15);
  expect_at({{0, 0.1, 0.25}, {1, 0.9, 1}}, {1.0 / 3}, 1e-14);  // x and y pass 0.5 together: a double root there
  expect_at({{0, 0.2, 0.3}, {1, 1, 0.9}}, {1.0 / 3, 0.375, 0.5}, 1e-14);
  expect_at({{0, 0, 0.25}, {1, 1, 0.25}}, {}, 0);  // a double root
  expect_at({{0, 0, 0}, {1, 1, 1}}, {0.5}, 1e-5);  // a triple root
}

TEST(LevelSetCrossings, PlateausAtTheLevelAreOutside) {
  const std::vector<int> row{0, 4, 1, 1, 4, 1, 0, 1, 4, 0};  // level 1
  const Scan scan = test::scan_of_function<std::uint8_t>({10, 2, 2}, [&](int i, int, int) { return row[i]; });
  const std::unique_ptr<Domain> domain = make_level_set(scan, {1, InsideSide::above, {}});
  Crossings crossings;
  domain->crossings({{-0.5, 0.5, 0.5}, {9.5, 0.5, 0.5}}, crossings);
  std::vector<double> x;
  for (const Crossing& crossing : crossings) x.push_back(crossing.point.x);
  const std::vector<double> expected{1.0 / 4, 2, 3, 5, 7, 8.75};
  ASSERT_EQ(x.size(), expected.size());
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], expected[i], 1e-14);
  EXPECT_EQ(domain->region_at({2.5, 0.5, 0.5}), kOutside);
  EXPECT_EQ(domain->region_at({5, 0.5, 0.5}), kOutside);
  EXPECT_EQ(domain->region_at({1.5, 0.5, 0.5}), 1);
}

TEST(LevelSet, ClosesWithinThePadding) {
  for (const auto& [name, frame] : test::frames()) {
    SCOPED_TRACE(name);
    const Scan scan = test::scan_of_function<float>(
        {5, 6, 7}, [](int i, int j, int k) { return i == 2 && j == 2 && k == 2 ? 0 : 10; }, frame);
    for (const double level : {0.0, 5.0}) {
      const std::unique_ptr<Domain> domain = make_level_set(scan, {level, InsideSide::above, {}});
      const Box box = domain->bounds();
      Crossings crossings;
      std::mt19937 random(16);
      for (int i = 0; i < 200; ++i) {
        const Point from = frame.to_world({1, 1, 1});
        domain->crossings({from, from + 100 * test::random_direction(random)}, crossings);
        ASSERT_FALSE(crossings.empty());
        EXPECT_EQ(crossings.back().to, kOutside);
        const Vec index = frame.to_index(crossings.back().point);
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_GT(index[axis], -1 + 1e-5);
          EXPECT_LT(index[axis], scan.size[axis] - 1e-5);
        }
        EXPECT_TRUE(box.contains(crossings.back().point));
      }
      EXPECT_EQ(domain->region_at(frame.to_world({-1, 3, 3})), kOutside);
      EXPECT_EQ(domain->region_at(frame.to_world({3, 3, 7.1})), kOutside);
    }
  }
}

TEST(LevelSet, TheOutsideValueMovesTheBorder) {
  const Scan scan = test::scan_of_function<float>({4, 4, 4}, [](int i, int, int) { return i == 0 ? 0 : 10; });
  const auto border = [&](std::optional<double> outside) {
    Crossings crossings;
    make_level_set(scan, {5, InsideSide::above, outside})->crossings({{2, 1.5, 1.5}, {9, 1.5, 1.5}}, crossings);
    return crossings.at(0).point.x;
  };
  EXPECT_NEAR(border({}), 3.5, 1e-14);
  EXPECT_NEAR(border(-5.0), 3 + 1.0 / 3, 1e-14);
  EXPECT_NEAR(border(-4995.0), 3.001, 1e-4);
  EXPECT_NEAR(border(5.0), 4, 3e-3);  // moved just below the level
  EXPECT_LT(border(5.0), 4);
}

TEST(LevelSet, RepeatableAndThreadSafe) {
  const std::unique_ptr<Domain> domain =
      make_level_set(test::noisy_ball<float>(kSize, test::frames()[2].frame), {50, InsideSide::above, {}});
  const auto answers = [&domain] {
    std::vector<double> numbers;
    std::mt19937 random(17);
    Crossings crossings;
    const Box box = domain->bounds();
    const Frame frame = test::frames()[2].frame;
    for (int i = 0; i < 3000; ++i) {
      const Segment s{frame.to_world(random_index(kSize, random)), frame.to_world(random_index(kSize, random))};
      domain->crossings(s, crossings);
      for (const Crossing& c : crossings) numbers.insert(numbers.end(), {c.point.x, c.point.y, c.point.z});
      numbers.push_back(domain->region_at(s.source));
    }
    numbers.push_back(static_cast<double>(domain->components().size()));
    domain->size_hints([&numbers](const SizeHint& feature) { numbers.push_back(feature.radius_mm); });
    domain->surface_candidates(box.diagonal(), [&numbers](const Point& p) { numbers.push_back(p.x); });
    return numbers;
  };
  std::vector<std::vector<double>> parallel(4);
  {
    std::vector<std::jthread> threads;
    for (auto& result : parallel) threads.emplace_back([&result, &answers] { result = answers(); });
  }
  for (const auto& result : parallel) EXPECT_EQ(result, answers());
}

TEST(LevelSet, ExtremeValuesOfIntegerTypes) {
  const auto check = [](auto least, auto most) {
    using Voxel = decltype(least);
    const Scan scan = test::scan_of_function<Voxel>({3, 3, 3}, [&](int i, int, int) { return i == 1 ? most : least; });
    const double level = 0.5 * (scan.min_value + scan.max_value);
    const std::unique_ptr<Domain> domain = make_level_set(scan, {level, InsideSide::above, {}});
    expect_agreement(*domain, {{-0.9, 1, 1}, {2.9, 1.1, 1}});
    EXPECT_EQ(domain->region_at({1, 1, 1}), 1);
    EXPECT_EQ(domain->region_at({0, 1, 1}), kOutside);
  };
  check(std::numeric_limits<std::int8_t>::min(), std::numeric_limits<std::int8_t>::max());
  check(std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max());
  check(std::numeric_limits<std::uint64_t>::min(), std::numeric_limits<std::uint64_t>::max());
  check(-1e30F, 1e30F);
}

template <class Voxel>
class LevelSetVoxels : public testing::Test {};
using VoxelTypes = testing::Types<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, std::uint32_t,
                                  std::int64_t, std::uint64_t, float, double>;
TYPED_TEST_SUITE(LevelSetVoxels, VoxelTypes);

TYPED_TEST(LevelSetVoxels, SameAnswersAsWithInt16) {
  const Frame frame = test::frames()[4].frame;
  const auto whole = [&]<class Voxel>(Voxel) {
    const Scan noisy = test::noisy_ball<std::int16_t>(kSize, frame);
    const auto* values = std::get<const std::int16_t*>(noisy.voxels);
    return test::scan_of(kSize, std::vector<Voxel>(values, values + noisy.voxel_count()), frame);
  };
  const std::unique_ptr<Domain> domain = make_level_set(whole(TypeParam{}), {50, InsideSide::above, {}});
  const std::unique_ptr<Domain> expected = make_level_set(whole(std::int16_t{}), {50, InsideSide::above, {}});
  std::mt19937 random(18);
  Crossings a;
  Crossings b;
  std::size_t total = 0;
  for (int i = 0; i < 300; ++i) {
    const Segment s{frame.to_world(random_index(kSize, random)), frame.to_world(random_index(kSize, random))};
    domain->crossings(s, a);
    expected->crossings(s, b);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t n = 0; n < a.size(); ++n) EXPECT_EQ(a[n].point, b[n].point);
    EXPECT_EQ(domain->region_at(s.source), expected->region_at(s.source));
    EXPECT_EQ(domain->residual_at(s.source), expected->residual_at(s.source));
    total += a.size();
  }
  EXPECT_GT(total, 300U);
}

}  // namespace
}  // namespace scantet
