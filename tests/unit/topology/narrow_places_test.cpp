// Places of which shape and thickness are known.
#include "scantet/topology/narrow_places.h"

#include <gtest/gtest.h>

#include "scantet/topology/level_topology.h"
#include "unit/image/test_scan.h"

namespace scantet {
namespace {

using namespace test;
using Size = std::array<int, 3>;

constexpr Size kCubeSize{9, 9, 9};

/// A scan of `far` with these voxels set to other values.
struct Dot {
  Size node;
  double value;
};
Scan dots(double far, const std::vector<Dot>& dots, const Frame& frame = {}) {
  return scan_of_function<float>(
      kCubeSize,
      [&](int i, int j, int k) {
        for (const Dot& dot : dots) {
          if (dot.node == Size{i, j, k}) return dot.value;
        }
        return far;
      },
      frame);
}

std::vector<SizeHint> places(const Scan& scan, double level = 0) {
  return LevelTopology(scan, {level, InsideSide::above, -10.0}).size_hints();
}

/// The places nearer than a nanometre to the index point.
std::vector<SizeHint> places_at(const std::vector<SizeHint>& all, const Frame& frame, const Vec& index) {
  std::vector<SizeHint> found;
  for (const SizeHint& feature : all) {
    if (distance(feature.point, frame.to_world(index)) < 1e-6) found.push_back(feature);
  }
  return found;
}

TEST(NarrowPlaces, IslandAndHoleOfOneNode) {
  for (const auto& [name, frame] : frames()) {
    SCOPED_TRACE(name);
    for (double sign : {1.0, -1.0}) {
      // The hole: a low node in a body of high ones.
      const std::vector<SizeHint> found = places(dots(-3 * sign, {{{4, 4, 4}, sign}}, frame));
      const std::vector<SizeHint> here = places_at(found, frame, {4, 4, 4});
      ASSERT_EQ(here.size(), 1U);
      EXPECT_NEAR(here[0].radius_mm, 0.25 * frame.min_spacing_mm(), 1e-6);
    }
  }
}

TEST(NarrowPlaces, BigSmoothBallHasNone) {
  const Scan ball = scan_of_function<float>({24, 24, 24}, [](int i, int j, int k) {
    return -distance({11.3, 11.6, 11.4}, {double(i), double(j), double(k)});
  });
  EXPECT_TRUE(places(ball, -9.1).empty());
}

TEST(NarrowPlaces, ThreadIsThinnestAtItsLowestNode) {
  std::vector<Dot> thread;
  for (int i = 0; i < 9; ++i) thread.push_back({{i, 4, 4}, 2.0 + std::abs(i - 5)});
  const std::vector<SizeHint> found = places(dots(-6, thread));
  ASSERT_EQ(places_at(found, {}, {5, 4, 4}).size(), 1U);
  EXPECT_NEAR(places_at(found, {}, {5, 4, 4})[0].radius_mm, 2.0 / 8, 1e-6);
  EXPECT_TRUE(places_at(found, {}, {4, 4, 4}).empty());
  EXPECT_TRUE(places_at(found, {}, {7, 4, 4}).empty());
}

TEST(NarrowPlaces, ThreadOfConstantThicknessIsOneAllAlong) {
  const Scan bridge = scan_of_function<std::uint8_t>(
      kCubeSize, [](int i, int j, int k) { return i < 2 || i > 6 || (j == 4 && k == 4) ? 100 : 0; });
  const std::vector<SizeHint> found = LevelTopology(bridge, {50, {}, {}}).size_hints();
  int on_thread = 0;
  for (const SizeHint& feature : found) on_thread += feature.point.y == 4 && feature.point.z == 4;
  EXPECT_EQ(on_thread, 5);
}

TEST(NarrowPlaces, SheetOfConstantThicknessIsNone) {
  const Scan wall = scan_of_function<std::uint8_t>(kCubeSize, [](int, int, int k) { return k == 4 ? 100 : 0; });
  EXPECT_TRUE(LevelTopology(wall, {50, {}, {}}).size_hints().empty());
}

TEST(NarrowPlaces, SheetIsThinnestAtItsLowestNode) {
  const auto sheet = [](double sign) {
    return scan_of_function<float>(kCubeSize, [sign](int i, int j, int k) {
      return sign * (k == 4 ? 1.0 + 0.1 * ((i - 3) * (i - 3) + (j - 5) * (j - 5)) : -4.0);
    });
  };
  for (double sign : {1.0, -1.0}) {  // a wall; a gap between two bodies
    const std::vector<SizeHint> found = places(sheet(sign));
    const std::vector<SizeHint> here = places_at(found, {}, {3, 5, 4});
    ASSERT_EQ(here.size(), 1U);
    EXPECT_NEAR(here[0].radius_mm, 0.2, 1e-6);
    EXPECT_TRUE(places_at(found, {}, {4, 5, 4}).empty());
  }
}

TEST(NarrowPlaces, FaceSaddleOfANeckAndOfAGap) {
  // Two nodes across a face's diagonal, in the plane k = 4: the saddle is in the middle of the face, of height
  // (p² - q²) / 2(p + q) = (p - q) / 2 with twist 2(p + q), and falls to (p - 3q) / 4 … -q across it.
  for (double q : {0.8, 1.2}) {
    const std::vector<SizeHint> found = places(dots(-q, {{{4, 4, 4}, 1}, {{5, 5, 4}, 1}}));
    const std::vector<SizeHint> here = places_at(found, {}, {4.5, 4.5, 4});
    ASSERT_EQ(here.size(), 1U) << q;
    const double s = (1 - q) / 2;
    const double along_face = std::sqrt(2 * std::abs(s) / (2 * (1 + q)));
    const double across = s > 0 ? s / (s + q) : 1;  // a gap: across leads away from the level
    EXPECT_NEAR(here[0].radius_mm, std::min(along_face, across), 1e-6) << q;
  }
}

TEST(NarrowPlaces, FaceSaddleOnAPlainSlopeIsNone) {
  // The same face, but the nodes above it are far inside: the surface only passes by.
  std::vector<Dot> nodes{{{4, 4, 4}, 1}, {{5, 5, 4}, 1}};
  for (int c = 0; c < 4; ++c) nodes.push_back({{4 + c % 2, 4 + c / 2, 5}, 5});
  EXPECT_TRUE(places_at(places(dots(-0.8, nodes)), {}, {4.5, 4.5, 4}).empty());
}

TEST(NarrowPlaces, BodySaddleOfATunnelInEveryFrame) {
  // Ends of a body diagonal: the saddle is in the middle, of height s = (p - 3q) / 4; in voxel units the Hessian has
  // p + q in each place off the diagonal.
  for (double q : {0.3, 0.4}) {
    for (const auto& [name, frame] : frames()) {
      SCOPED_TRACE(name);
      const std::vector<SizeHint> found = places(dots(-q, {{{4, 4, 4}, 1}, {{5, 5, 5}, 1}}, frame));
      const std::vector<SizeHint> here = places_at(found, frame, {4.5, 4.5, 4.5});
      ASSERT_EQ(here.size(), 1U);
      // Distance to where the quadratic s + ½ xᵀHx vanishes, by trying directions in world space.
      const double s = (1 - 3 * q) / 4;
      std::mt19937 random(4);
      double nearest = 1e9;
      for (int n = 0; n < 20000; ++n) {
        const Vec d = random_direction(random);
        const Vec u = frame.to_index(frame.origin() + d);
        const double curvature = 2 * (1 + q) * (u.x * u.y + u.y * u.z + u.x * u.z);
        if (curvature * s < 0) nearest = std::min(nearest, std::sqrt(-2 * s / curvature));
      }
      EXPECT_LE(here[0].radius_mm, nearest * (1 + 1e-6));
      EXPECT_GE(here[0].radius_mm, nearest * 0.99);
    }
  }
}

TEST(NarrowPlaces, SmallComponentHasOneAtItsWitness) {
  const std::vector<SizeHint> found = places(dots(-1, {{{3, 3, 3}, 1}, {{4, 3, 3}, 3}, {{4, 4, 3}, 2}}));
  ASSERT_EQ(places_at(found, {}, {4, 3, 3}).size(), 1U);
  EXPECT_NEAR(places_at(found, {}, {4, 3, 3})[0].radius_mm, 0.75, 1e-6);
}

TEST(NarrowPlaces, RadiiAreWithinTheirLimits) {
  for (const auto& [name, frame] : frames()) {
    SCOPED_TRACE(name);
    for (const Scan& scan : {noisy_ball<float>({20, 18, 16}, frame), plateaus<float>({12, 13, 14}, frame)}) {
      const std::vector<SizeHint> found = places(scan, scan.max_value > 10 ? 50 : 1);
      EXPECT_GT(found.size(), 30U);
      for (const SizeHint& feature : found) {
        EXPECT_GE(feature.radius_mm, 1e-3 * frame.min_spacing_mm());
        EXPECT_LT(feature.radius_mm, frame.min_spacing_mm());
        EXPECT_TRUE(is_finite(feature.point));
      }
    }
  }
}

}  // namespace
}  // namespace scantet
