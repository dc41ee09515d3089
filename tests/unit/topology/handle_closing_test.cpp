// Shapes with handles that are known, and noise, before and after.
#include "scantet/topology/handle_closing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <set>

#include "scantet/base/parallel.h"
#include "scantet/image/level_set.h"
#include "scantet/topology/component_match.h"
#include "scantet/topology/level_topology.h"
#include "unit/image/parts_of_samples.h"
#include "unit/image/test_scan.h"

namespace scantet {
namespace {

using namespace test;

using Shape = std::function<double(const Vec&)>;  // signed distance, positive inside, voxel units

Scan scan_of_shape(const std::array<int, 3>& size, const Shape& shape, const Frame& frame = {}) {
  return scan_of_function<float>(
      size,
      [&](int i, int j, int k) {
        return std::clamp(shape({double(i), double(j), double(k)}), -3.0, 3.0);
      },
      frame);
}

double torus(const Vec& p, const Vec& center, double ring, double tube) {
  const Vec d = p - center;
  return tube - std::hypot(std::hypot(d.x, d.y) - ring, d.z);
}

double ball(const Vec& p, const Vec& center, double radius) {
  return radius - distance(p, center);
}

/// A straight rod from a to b with round ends.
double rod(const Vec& p, const Vec& a, const Vec& b, double radius) {
  const double t = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
  return radius - distance(p, a + t * (b - a));
}

LevelSetSettings at(const Scan& scan, double level, InsideSide inside = InsideSide::above) {
  return checked_settings(scan, {level, inside, std::nullopt});
}

ClosedHandles close(const Scan& scan, double thinner_mm, double level = 0) {
  return close_handles(scan, at(scan, level), thinner_mm);
}

struct Betti {
  Counts parts;
  std::int64_t handles = 0;
};

Betti betti(const Scan& scan, const LevelSetSettings& settings) {
  const LevelTopology topology(scan, settings);
  Betti found{counts(topology), 0};
  for (const Component& component : topology.components()) {
    if (component.region != kOutside) found.handles += component.handles().value();
  }
  return found;
}

/// How many voxels differ.
std::int64_t changes(const Scan& a, const Scan& b) {
  return std::visit(
      [&]<class Voxel>(const Voxel* voxels) {
        const auto* others = std::get<const Voxel*>(b.voxels);
        std::int64_t count = 0;
        for (std::int64_t n = 0; n < a.voxel_count(); ++n) count += voxels[n] != others[n];
        return count;
      },
      a.voxels);
}

/// That only handles have gone, as many as it is said, and that values changed as it is said.
void expect_sound(const Scan& scan, const ClosedHandles& closed, const LevelSetSettings& settings) {
  const Betti before = betti(scan, settings);
  const Betti after = betti(closed.scan, settings);
  EXPECT_EQ(after.parts, before.parts);
  ASSERT_TRUE(closed.had.has_value());
  EXPECT_EQ(*closed.had, before.handles);
  EXPECT_EQ(closed.left, after.handles);
  EXPECT_LE(after.handles, before.handles);
  EXPECT_EQ(changes(scan, closed.scan), static_cast<std::int64_t>(closed.voxels));
  EXPECT_EQ(closed.scan.voxels.index(), scan.voxels.index());
  EXPECT_EQ(closed.scan.min_value, scan.min_value);
  EXPECT_EQ(closed.scan.max_value, scan.max_value);
  EXPECT_EQ(closed.scan.owner == scan.owner, closed.voxels == 0);
  const auto heights = [&](const Scan& of) { return make_height_grid(of, settings); };
  EXPECT_TRUE(differing_components(*heights(scan), *heights(closed.scan), Progress()).empty());
}

TEST(HandleClosing, ARingIsCutIfItIsThinner) {
  for (const auto& [name, frame] : frames()) {
    SCOPED_TRACE(name);
    const Scan scan = scan_of_shape(
        {19, 19, 9},
        [](const Vec& p) {
          return torus(p, {9.1, 9.2, 4.1}, 5.4, 1.3);
        },
        frame);
    const double spacing = std::max({frame.spacing_mm(0), frame.spacing_mm(1), frame.spacing_mm(2)});
    const ClosedHandles kept = close(scan, 0.8 * frame.min_spacing_mm());
    EXPECT_EQ(kept.voxels, 0U);
    EXPECT_EQ(kept.left, 1);
    expect_sound(scan, kept, at(scan, 0));
    const ClosedHandles cut = close(scan, 4 * spacing);
    EXPECT_EQ(cut.left, 0);
    EXPECT_EQ(cut.cut + cut.filled, 1U);
    EXPECT_LT(cut.voxels, 60U);
    expect_sound(scan, cut, at(scan, 0));
  }
}

TEST(HandleClosing, WidthsAreThoseOfTheShape) {
  // In spacings of 1 mm the tube is 2.6 mm thick, and the hole 8.2 mm.
  const Scan scan = scan_of_shape({19, 19, 9}, [](const Vec& p) { return torus(p, {9.1, 9.2, 4.1}, 5.4, 1.3); });
  EXPECT_EQ(close(scan, 2).left, 1);
  const ClosedHandles cut = close(scan, 3.6);
  EXPECT_EQ(cut.left, 0);
  EXPECT_EQ(cut.cut, 1U);
}

TEST(HandleClosing, SmallHolesAreFilledAndLargeOnesStay) {
  const Scan scan = scan_of_shape({40, 24, 16}, [](const Vec& p) {
    const double plate = 4.2 - std::abs(p.z - 7.6);
    const double small = std::hypot(p.x - 8.2, p.y - 11.3) - 1.1;
    const double large = std::hypot(p.x - 26.1, p.y - 11.7) - 5.2;
    const double rim = std::min({p.x - 1.5, 37.5 - p.x, p.y - 1.5, 21.5 - p.y});
    return std::min({plate, small, large, rim});
  });
  const ClosedHandles closed = close(scan, 4);
  expect_sound(scan, closed, at(scan, 0));
  EXPECT_EQ(closed.had, 2);
  EXPECT_EQ(closed.left, 1);
  EXPECT_EQ(closed.cut, 0U);
  EXPECT_EQ(closed.filled, 1U);
  EXPECT_LE(closed.voxels, 8U);
}

TEST(HandleClosing, ASheetIsNotSlitForALargeHole) {
  const Scan scan = scan_of_shape({30, 30, 8}, [](const Vec& p) {
    const double sheet = 0.8 - std::abs(p.z - 3.6);
    const double hole = std::hypot(p.x - 14.3, p.y - 14.6) - 5.2;
    return std::min({sheet, hole, std::min({p.x, 29 - p.x, p.y, 29 - p.y}) - 1.5});
  });
  const ClosedHandles closed = close(scan, 4);
  expect_sound(scan, closed, at(scan, 0));
  EXPECT_EQ(closed.had, 1);
  EXPECT_EQ(closed.left, 1);
  EXPECT_GE(closed.wide, 1U);
}

TEST(HandleClosing, ABridgeBetweenPartsStaysAndOneBesideItIsCut) {
  const auto shape = [](bool second) {
    return [second](const Vec& p) {
      double d = std::max(ball(p, {8.1, 8.2, 8.1}, 4.6), ball(p, {23.2, 8.1, 8.2}, 4.7));
      d = std::max(d, rod(p, {8, 9.8, 8}, {23, 9.8, 8}, 0.95));
      return second ? std::max(d, rod(p, {8, 6, 8}, {23, 6, 8}, 0.7)) : d;
    };
  };
  const Scan one = scan_of_shape({32, 17, 17}, shape(false));
  EXPECT_EQ(close(one, 3.5).voxels, 0U);
  const Scan two = scan_of_shape({32, 17, 17}, shape(true));
  const ClosedHandles closed = close(two, 3.5);
  expect_sound(two, closed, at(two, 0));
  EXPECT_EQ(closed.had, 1);
  EXPECT_EQ(closed.left, 0);
  EXPECT_EQ(closed.cut, 1U);
  // The thinner one, at y = 6.
  const LevelSetSettings settings = at(two, 0);
  for (int j = 8; j < 12; ++j) {
    for (int i = 0; i < two.size[0]; ++i) {
      const auto height = [&](const Scan& scan) { return make_height_grid(scan, settings)->height(i, j, 8); };
      EXPECT_EQ(height(two), height(closed.scan)) << i << ' ' << j;
    }
  }
}

TEST(HandleClosing, ShellsAroundCavitiesStay) {
  const auto shell = [](const Vec& p) { return 0.7 - std::abs(6.3 - distance(p, {9.2, 9.1, 9.3})); };
  const Scan closed_shell = scan_of_shape({19, 19, 19}, shell);
  const ClosedHandles closed = close(closed_shell, 6);
  EXPECT_EQ(closed.voxels, 0U);
  expect_sound(closed_shell, closed, at(closed_shell, 0));
  // With two holes it has a handle and no cavity.
  const Scan open_shell = scan_of_shape(
      {19, 19, 19}, [&](const Vec& p) { return std::min(shell(p), std::hypot(p.x - 9.2, p.y - 9.4) - 1.2); });
  const ClosedHandles filled = close(open_shell, 4);
  expect_sound(open_shell, filled, at(open_shell, 0));
  EXPECT_EQ(filled.had, 1);
  EXPECT_EQ(filled.left, 0);
}

TEST(HandleClosing, AHandleThroughTheMiddleOfAFaceIsCut) {
  // A ring of nodes that is closed by a diagonal of a face alone.
  const auto ring = [](double around) {
    return scan_of_function<double>({7, 7, 5}, [around](int i, int j, int k) {
      const bool square =
          k == 2 && std::min(i, j) >= 1 && std::max(i, j) <= 5 && (i == 1 || j == 1 || i == 5 || j == 5);
      const bool corner = i == 1 && j == 1;
      return square && !corner ? 1.0 : around;
    });
  };
  for (const double around : {-0.5, -1.5}) {
    const Scan scan = ring(around);
    const ClosedHandles closed = close(scan, 2);
    EXPECT_EQ(closed.had, around > -1 ? 1 : 0);
    EXPECT_EQ(closed.left, 0);
    EXPECT_EQ(closed.voxels > 0, around > -1);
    expect_sound(scan, closed, at(scan, 0));
  }
}

TEST(HandleClosing, BelowTheLevelItIsTheSame) {
  const auto shape = [](const Vec& p) { return torus(p, {9.1, 9.2, 4.1}, 5.4, 1.3); };
  const Scan above = scan_of_shape({19, 19, 9}, shape);
  const Scan below = scan_of_shape({19, 19, 9}, [&](const Vec& p) { return -shape(p); });
  const LevelSetSettings settings = at(below, 0, InsideSide::below);
  const ClosedHandles closed = close_handles(below, settings, 4);
  expect_sound(below, closed, settings);
  EXPECT_EQ(closed.left, 0);
  EXPECT_EQ(closed.voxels, close(above, 4).voxels);
}

/// Noise smoothed by means of three, times.
template <class Voxel>
Scan noise(unsigned seed, int times, double scale, const Frame& frame = {}) {
  const std::array<int, 3> size{26, 23, 24};
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(0, 1);
  std::vector<double> values(static_cast<std::size_t>(size[0]) * size[1] * size[2]);
  for (double& v : values) v = value(random);
  for (int n = 0; n < 3 * times; ++n) {
    const std::size_t step = n % 3 == 0 ? 1 : n % 3 == 1 ? size[0] : static_cast<std::size_t>(size[0]) * size[1];
    std::vector<double> smooth = values;
    for (std::size_t v = step; v + step < values.size(); ++v) {
      smooth[v] = (values[v - step] + values[v] + values[v + step]) / 3;
    }
    values = smooth;
  }
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double least = *low;
  const double range = *high - least;
  std::size_t n = 0;
  return scan_of_function<Voxel>(
      size, [&](int, int, int) { return scale * (values[n++] - least) / range; }, frame);
}

TEST(HandleClosing, OnlyHandlesVanishFromNoise) {
  std::int64_t gone = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const auto all_frames = frames();
    const Scan scan = noise<float>(seed, 1 + static_cast<int>(seed % 3), 1, all_frames[seed % all_frames.size()].frame);
    for (const InsideSide inside : {InsideSide::above, InsideSide::below}) {
      const LevelSetSettings settings = at(scan, 0.35 + 0.015 * seed, inside);
      const ClosedHandles closed = close_handles(scan, settings, (1 + seed % 4) * scan.frame.min_spacing_mm());
      expect_sound(scan, closed, settings);
      gone += *closed.had - closed.left;
      EXPECT_LE(20 * closed.taken_back, closed.cut + closed.filled) << "beside each other";
    }
  }
  EXPECT_GT(gone, 500);
}

TEST(HandleClosing, OnlyHandlesVanishWhereNodesAreAtTheLevel) {
  std::int64_t gone = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const Scan scan = noise<std::uint8_t>(seed, 1 + static_cast<int>(seed % 3), 6 + 3 * (seed % 5));
    const double level = std::round(0.5 * scan.max_value);
    for (const InsideSide inside : {InsideSide::above, InsideSide::below}) {
      const LevelSetSettings settings = at(scan, level, inside);
      const auto had = close_handles(scan, settings, 1).had;
      const ClosedHandles closed = close_handles(scan, settings, 3);
      if (!had) continue;  // not known, and told so
      expect_sound(scan, closed, settings);
      gone += *closed.had - closed.left;
    }
  }
  EXPECT_GT(gone, 200);
}

TEST(HandleClosing, MoreIsClosedOfWiderHandles) {
  const Scan scan = noise<float>(7, 2, 1);
  std::int64_t left = std::numeric_limits<std::int64_t>::max();
  for (const double thinner_mm : {0.5, 1.0, 2.0, 4.0, 8.0}) {
    const ClosedHandles closed = close(scan, thinner_mm, 0.5);
    EXPECT_LE(closed.left, left);
    left = closed.left;
  }
  EXPECT_LT(10 * left, *close(scan, 1, 0.5).had);
}

template <class Voxel>
class HandleClosingTypes : public testing::Test {};
using Voxels = testing::Types<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, std::uint32_t,
                              std::int64_t, std::uint64_t, float, double>;
TYPED_TEST_SUITE(HandleClosingTypes, Voxels);

TYPED_TEST(HandleClosingTypes, ValuesStayInTheirTypeAndRange) {
  using Voxel = TypeParam;
  const bool is_whole = std::is_integral_v<Voxel>;
  const double scale = is_whole ? 100 : 1;
  const Scan scan = noise<Voxel>(3, 1, scale);
  for (const double level : {0.5 * scale, 0.5 * scale + 0.3}) {
    if (!is_whole && level > 0.6) continue;
    const LevelSetSettings settings = at(scan, level);
    const ClosedHandles closed = close_handles(scan, settings, 3);
    expect_sound(scan, closed, settings);
    EXPECT_GT(closed.voxels, 10U);
    const Voxel* before = std::get<const Voxel*>(scan.voxels);
    const Voxel* after = std::get<const Voxel*>(closed.scan.voxels);
    for (std::int64_t n = 0; n < scan.voxel_count(); ++n) {
      if (before[n] == after[n]) continue;
      const auto was = static_cast<double>(before[n]);
      const auto is = static_cast<double>(after[n]);
      EXPECT_NE(was > level, is > level);
      EXPECT_NE(is, level);
      EXPECT_GE(is, scan.min_value);
      EXPECT_LE(is, scan.max_value);
      const double least = is_whole ? 1 : 1e-3;
      EXPECT_LE(std::abs(is - level), std::max(std::abs(was - level), least) + (is_whole ? 1 : 1e-6));
    }
  }
}

TEST(HandleClosing, AtTheLeastValueOfAMaskTunnelsAreFilledAlone) {
  const auto mask = [](int i, int j, int k) {
    const bool ring = k >= 3 && k <= 4 && std::min(i, j) >= 2 && std::max(i, j) <= 8;
    return ring && (std::min(i, j) < 4 || std::max(i, j) > 6) ? 1 : 0;
  };
  const Scan scan = scan_of_function<std::uint8_t>({11, 11, 8}, mask);
  for (const double level : {0.0, 0.5}) {
    SCOPED_TRACE(level);
    const ClosedHandles closed = close(scan, 4, level);
    expect_sound(scan, closed, at(scan, level));
    EXPECT_EQ(closed.had, 1);
    EXPECT_EQ(closed.left, 0);
    EXPECT_EQ(closed.only_fills, level == 0);
    EXPECT_EQ(closed.cut, level == 0 ? 0U : 1U);
  }
}

TEST(HandleClosing, NothingIsCutAtTheBorder) {
  // Two plates in all of the image, and all of it but a corner.
  const Scan plates = scan_of_function<float>({8, 8, 8}, [](int, int, int k) { return k % 4 < 2 ? 1 : -1; });
  const Scan full = scan_of_function<float>({8, 8, 8}, [](int i, int j, int k) { return i + j + k > 0 ? 1 : -1; });
  const Scan least = scan_of_function<float>({2, 2, 2}, [](int i, int j, int k) { return i + j + k > 0 ? 1 : -1; });
  for (const Scan& scan : {plates, full, least}) {
    const ClosedHandles closed = close(scan, 100);
    EXPECT_EQ(closed.voxels, 0U);
    expect_sound(scan, closed, at(scan, 0));
  }
}

TEST(HandleClosing, ThreadsDoNotMatter) {
  const Scan scan = noise<float>(11, 1, 1);
  std::vector<std::vector<float>> outcomes;
  for (const std::size_t threads : {1, 2, 3, 8}) {
    with_threads(threads, [&] {
      const ClosedHandles closed = close(scan, 3, 0.5);
      EXPECT_GT(closed.voxels, 100U);
      const auto* voxels = std::get<const float*>(closed.scan.voxels);
      outcomes.emplace_back(voxels, voxels + scan.voxel_count());
    });
  }
  for (const auto& outcome : outcomes) EXPECT_EQ(outcome, outcomes.front());
}

TEST(HandleClosing, EndsWhenCancelled) {
  class Cancelled final : public Progress {
    bool cancelled() const override { return true; }
  };
  const Scan scan = noise<float>(11, 1, 1);
  EXPECT_EQ(close_handles(scan, at(scan, 0.5), 3, Cancelled()).voxels, 0U);
}

}  // namespace
}  // namespace scantet
