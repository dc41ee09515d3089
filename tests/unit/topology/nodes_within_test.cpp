// Against solid angles, and against bodies whose edges and corners lie on the rows of the grid.
#include "scantet/topology/nodes_within.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "scantet/base/geometry.h"

namespace scantet {
namespace {

bool is_set(const NodeBits& bits, int i, int j, int k) {
  return (bits.row(j, k)[(i + 1) / 64] >> ((i + 1) % 64) & 1U) != 0;
}

/// The solid angle of a closed surface, turned outwards, as p sees it: 4π inside, 0 outside (van Oosterom and Strackee,
/// *The solid angle of a plane triangle*, 1983).
double solid_angle(const TriangleSurface& surface, const Point& p) {
  double sum = 0;
  for (const Triangle& facet : surface.facets) {
    const std::array<Vec, 3> r{surface.vertices[facet[0]] - p, surface.vertices[facet[1]] - p,
                               surface.vertices[facet[2]] - p};
    const std::array<double, 3> l{length(r[0]), length(r[1]), length(r[2])};
    const double volume = dot(r[0], cross(r[1], r[2]));
    const double rest = l[0] * l[1] * l[2] + dot(r[0], r[1]) * l[2] + dot(r[0], r[2]) * l[1] + dot(r[1], r[2]) * l[0];
    sum += 2 * std::atan2(volume, rest);
  }
  return sum;
}

/// A crumpled ball around a point of the grid, in world coordinates.
TriangleSurface crumpled_ball(const Frame& frame, const Vec& centre, double radius, double crumpling) {
  constexpr int kAround = 40;
  constexpr int kRings = 20;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(1 - crumpling, 1 + crumpling);
  TriangleSurface ball;
  const auto add = [&](const Vec& direction) {
    ball.vertices.push_back(frame.to_world(centre + radius * share(random) * direction));
  };
  for (int ring = 1; ring < kRings; ++ring) {
    const double polar = std::numbers::pi * ring / kRings;
    for (int n = 0; n < kAround; ++n) {
      const double around = 2 * std::numbers::pi * n / kAround;
      add({std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar)});
    }
  }
  const auto top = static_cast<VertexId>(ball.vertices.size());
  add({0, 0, 1});
  add({0, 0, -1});
  const auto at = [](int ring, int n) { return static_cast<VertexId>((ring - 1) * kAround + n % kAround); };
  for (int n = 0; n < kAround; ++n) {
    ball.facets.push_back({top, at(1, n), at(1, n + 1)});
    ball.facets.push_back({top + 1, at(kRings - 1, n + 1), at(kRings - 1, n)});
    for (int ring = 1; ring < kRings - 1; ++ring) {
      ball.facets.push_back({at(ring, n), at(ring + 1, n), at(ring + 1, n + 1)});
      ball.facets.push_back({at(ring, n), at(ring + 1, n + 1), at(ring, n + 1)});
    }
  }
  return ball;
}

TEST(NodesWithin, AreThoseThatSeeTheSurfaceAllAround) {
  const std::array<int, 3> size{90, 30, 25};  // rows of two words
  const Frame oblique({Vec{0.5, 0.1, 0}, Vec{-0.1, 0.8, 0.1}, Vec{0, 0.2, 1.5}}, {3, -4, 5});
  for (const Frame& frame : {Frame{}, oblique}) {
    const TriangleSurface ball = crumpled_ball(frame, {62, 14, 13}, 20, 0.3);  // beyond the grid along y and z
    const NodeBits bits = nodes_within(ball, frame, size);
    int inside = 0;
    for (int n = 0; n < size[0] * size[1] * size[2]; n += 7) {
      const int i = n % size[0];
      const int j = n / size[0] % size[1];
      const int k = n / (size[0] * size[1]);
      const double angle = std::abs(solid_angle(ball, frame.to_world({double(i), double(j), double(k)})));
      EXPECT_EQ(is_set(bits, i, j, k), angle > 2 * std::numbers::pi) << i << ' ' << j << ' ' << k;
      inside += angle > 2 * std::numbers::pi ? 1 : 0;
    }
    EXPECT_GT(inside, 1000);
  }
}

TEST(NodesWithin, AreRightWhereRowsMeetEdgesAndCorners) {
  const std::array<int, 3> size{70, 21, 21};
  constexpr int kRadius = 8;
  TriangleSurface octahedron;
  const Point centre{60, 10, 10};
  for (int axis = 0; axis < 3; ++axis) {
    for (const int step : {-kRadius, kRadius}) {
      Point p = centre;
      p[axis] += step;
      octahedron.vertices.push_back(p);
    }
  }
  for (VertexId x : {0U, 1U}) {
    for (VertexId y : {2U, 3U}) {
      for (VertexId z : {4U, 5U}) octahedron.facets.push_back({x, y, z});
    }
  }
  const NodeBits bits = nodes_within(octahedron, Frame{}, size);
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        const int off = std::abs(i - 60) + std::abs(j - 10) + std::abs(k - 10);
        if (off == kRadius) continue;  // on the surface
        EXPECT_EQ(is_set(bits, i, j, k), off < kRadius) << i << ' ' << j << ' ' << k;
      }
    }
  }
}

}  // namespace
}  // namespace scantet
