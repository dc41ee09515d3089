// Spheres and rings of known handles.
#include "scantet/base/handle_loops.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>

#include "scantet/base/parallel.h"

namespace scantet {
namespace {

constexpr double kMajor = 5;
constexpr double kMinor = 1;
constexpr std::uint32_t kAlong = 60;
constexpr std::uint32_t kAround = 24;

/// A ring about the z axis. Its facets, of which each quadrangle has two, are added to a surface.
void add_ring(TriangleSurface& surface, const Point& center) {
  const auto first = static_cast<VertexId>(surface.vertices.size());
  for (std::uint32_t i = 0; i < kAlong; ++i) {
    for (std::uint32_t j = 0; j < kAround; ++j) {
      const double u = 2 * std::numbers::pi * i / kAlong;
      const double v = 2 * std::numbers::pi * j / kAround;
      const double r = kMajor + kMinor * std::cos(v);
      surface.vertices.push_back(center + Vec{r * std::cos(u), r * std::sin(u), kMinor * std::sin(v)});
    }
  }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return first + i % kAlong * kAround + j % kAround; };
  for (std::uint32_t i = 0; i < kAlong; ++i) {
    for (std::uint32_t j = 0; j < kAround; ++j) {
      surface.facets.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      surface.facets.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
}

/// A closed pile of rings of vertices about the z axis. radius: of each, one above the other by 0.2.
TriangleSurface pile(const std::vector<double>& radius) {
  TriangleSurface surface;
  for (std::size_t k = 0; k < radius.size(); ++k) {
    for (std::uint32_t j = 0; j < kAround; ++j) {
      const double v = 2 * std::numbers::pi * j / kAround;
      surface.vertices.push_back({radius[k] * std::cos(v), radius[k] * std::sin(v), 0.2 * double(k)});
    }
  }
  const auto at = [](std::size_t k, std::uint32_t j) { return static_cast<VertexId>(k * kAround + j % kAround); };
  for (std::size_t k = 0; k + 1 < radius.size(); ++k) {
    for (std::uint32_t j = 0; j < kAround; ++j) {
      surface.facets.push_back({at(k, j), at(k, j + 1), at(k + 1, j + 1)});
      surface.facets.push_back({at(k, j), at(k + 1, j + 1), at(k + 1, j)});
    }
  }
  for (std::uint32_t j = 1; j + 1 < kAround; ++j) {
    surface.facets.push_back({at(0, 0), at(0, j + 1), at(0, j)});
    surface.facets.push_back({at(radius.size() - 1, 0), at(radius.size() - 1, j), at(radius.size() - 1, j + 1)});
  }
  return surface;
}

std::vector<HandleLoop> all_loops(const TriangleSurface& surface, double longest_mm) {
  return handle_loops(
      surface, [=](const Point&) { return longest_mm; }, [](const HandleLoop&) { return true; });
}

/// Whether each vertex is joined to the next one by an edge.
bool is_closed_path(const HandleLoop& loop, const TriangleSurface& surface) {
  for (std::size_t n = 0; n < loop.vertices.size(); ++n) {
    const VertexId a = loop.vertices[n];
    const VertexId b = loop.vertices[(n + 1) % loop.vertices.size()];
    const auto has_both = [&](const Triangle& t) {
      return std::find(t.begin(), t.end(), a) != t.end() && std::find(t.begin(), t.end(), b) != t.end();
    };
    if (a == b || std::none_of(surface.facets.begin(), surface.facets.end(), has_both)) return false;
  }
  return true;
}

TEST(HandleLoops, OfARingGoAroundItsBody) {
  TriangleSurface ring;
  add_ring(ring, {10, 20, 30});
  const double around_mm = 2 * std::numbers::pi * kMinor;
  const std::vector<HandleLoop> loops = all_loops(ring, 1.1 * around_mm);
  ASSERT_FALSE(loops.empty());
  for (const HandleLoop& loop : loops) {
    EXPECT_TRUE(is_closed_path(loop, ring));
    EXPECT_NEAR(loop.length_mm, around_mm, 0.1);
    EXPECT_NEAR(std::hypot(loop.center.x - 10, loop.center.y - 20), kMajor, 0.1);
    EXPECT_NEAR(loop.center.z, 30, 0.1);
  }
  for (std::size_t i = 1; i < loops.size(); ++i) {
    EXPECT_LE(loops[i - 1].length_mm, loops[i].length_mm);
    for (std::size_t k = 0; k < i; ++k) EXPECT_GE(distance(loops[i].center, loops[k].center), 0.5 * loops[i].length_mm);
  }
  EXPECT_TRUE(all_loops(ring, 0.9 * around_mm).empty()) << "too long for that";
}

TEST(HandleLoops, OfARingGoThroughItsHoleWhenTheyMayBeSoLong) {
  TriangleSurface ring;
  add_ring(ring, {});
  const double through_mm = 2 * std::numbers::pi * (kMajor - kMinor);
  const auto is_long = [=](const HandleLoop& loop) { return loop.length_mm > 0.9 * through_mm; };
  const std::vector<HandleLoop> loops = handle_loops(
      ring, [=](const Point&) { return 1.1 * through_mm; }, is_long);
  ASSERT_EQ(loops.size(), 1U);
  EXPECT_LT(length(loops[0].center - Point{}), 0.1 * kMajor) << "the shortest through the vertices searched from";
  EXPECT_NEAR(loops[0].length_mm, through_mm, 0.01 * through_mm) << "beside the shortest of all";
}

TEST(HandleLoops, AroundAWaistPartTheSurface) {
  const TriangleSurface waist = pile({1, 2, 2, 2, 1, 0.3, 0.3, 1, 2, 2, 2, 1});
  std::atomic<int> asked{0};
  const auto count = [&](const HandleLoop&) {
    ++asked;
    return true;
  };
  EXPECT_TRUE(handle_loops(
                  waist, [](const Point&) { return 4; }, count)
                  .empty());
  EXPECT_GT(asked, 0) << "the waist itself";
}

TEST(HandleLoops, AreThoseThatAreAskedFor) {
  TriangleSurface rings;
  add_ring(rings, {});
  add_ring(rings, {100, 0, 0});
  const auto is_right = [](const HandleLoop& loop) { return loop.center.x > 50; };
  const std::vector<HandleLoop> loops = handle_loops(
      rings, [](const Point&) { return 7; }, is_right);
  ASSERT_FALSE(loops.empty());
  for (const HandleLoop& loop : loops) EXPECT_GT(loop.center.x, 50);
  const auto only_left = [](const Point& p) { return p.x < 50 ? 7.0 : 0.0; };
  EXPECT_TRUE(handle_loops(rings, only_left, is_right).empty());
}

TEST(HandleLoops, AreTheSameForAnyNumberOfThreads) {
  TriangleSurface rings;
  for (int n = 0; n < 12; ++n) add_ring(rings, {13.0 * n, 0, 0});
  const auto run = [&](std::size_t threads) {
    std::vector<HandleLoop> loops;
    with_threads(threads, [&] { loops = all_loops(rings, 7); });
    return loops;
  };
  const std::vector<HandleLoop> one = run(1);
  const std::vector<HandleLoop> four = run(4);
  ASSERT_FALSE(one.empty());
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t n = 0; n < one.size(); ++n) EXPECT_EQ(one[n].vertices, four[n].vertices);
}

TEST(HandleLoops, LeaveEdgesOfMoreThanTwoFacetsAlone) {
  TriangleSurface ring;
  add_ring(ring, {});
  const std::size_t whole = ring.facets.size();
  for (std::size_t f = 0; f < whole; ++f) ring.facets.push_back(ring.facets[f]);
  EXPECT_TRUE(all_loops(ring, 7).empty());
}

TEST(HandleLoops, OfNothingAreNone) {
  EXPECT_TRUE(all_loops({}, 7).empty());
}

}  // namespace
}  // namespace scantet
