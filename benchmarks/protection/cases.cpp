// The domains: a cube, one sheared to edges of 20 degrees, two balls that meet (the first wins, or their intersection
// is a region of its own), four Voronoi cells in a ball, a ball of which a plane cuts a thin slice, and a plate. About
// 20 mm wide.
#include <array>
#include <numbers>
#include <random>

#include "arrangement.h"

namespace scantet::bench {
namespace {

/// A rotation by random angles with a shift, so that nothing is aligned with the axes.
struct Pose {
  Vec x, y, z, shift;
  explicit Pose(unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const auto draw = [&] {
      const double a = normal(random), b = normal(random), c = normal(random);
      return Vec{a, b, c};
    };
    x = unit(draw());
    y = unit(cross(x, draw()));
    z = cross(x, y);
    shift = draw();
  }
  Vec turn(const Vec& v) const { return v.x * x + v.y * y + v.z * z; }
  Point place(const Point& p) const { return shift + turn(p); }
};

Curve segment(const std::vector<Corner>& corners, int from, int to) {
  Curve curve;
  curve.origin = corners[from].point;
  curve.length = distance(corners[from].point, corners[to].point);
  curve.u = unit(corners[to].point - corners[from].point);
  curve.corner[0] = from;
  curve.corner[1] = to;
  return curve;
}

/// The box spanned by three edges, region 1.
Arrangement parallelepiped(const Pose& pose, const std::array<Vec, 3>& edges) {
  std::array<Vec, 3> e;
  Point low = pose.shift;
  for (int i = 0; i < 3; ++i) {
    e[i] = pose.turn(edges[i]);
    low = low - 0.5 * e[i];
  }
  std::vector<Primitive> planes;
  for (int i = 0; i < 3; ++i) {
    const Vec across = cross(e[(i + 1) % 3], e[(i + 2) % 3]);
    const Vec normal = unit(dot(across, e[i]) > 0 ? across : -1 * across);
    planes.push_back({false, normal, dot(normal, low + e[i])});
    planes.push_back({false, -1 * normal, -dot(normal, low)});
  }
  std::vector<Corner> corners;
  corners.reserve(8);
  for (int i = 0; i < 8; ++i) corners.push_back({low + (i & 1) * e[0] + (i >> 1 & 1) * e[1] + (i >> 2 & 1) * e[2], 0});
  std::vector<Curve> curves;
  for (int i = 0; i < 8; ++i) {
    for (int axis = 0; axis < 3; ++axis)
      if (!(i >> axis & 1)) curves.push_back(segment(corners, i, i | 1 << axis));
  }
  const auto region = [planes](const Point& p) {
    for (const Primitive& plane : planes)
      if (dot(plane.normal_or_center, p) > plane.offset_or_radius) return 0;
    return 1;
  };
  double radius = 0;
  for (const Corner& corner : corners) radius = std::max(radius, distance(corner.point, pose.shift));
  return {planes, region, curves, corners, pose.shift, radius};
}

/// Balls of radius 10 and 8 mm, 12 mm apart. lens: what both hold is region 3, else the first ball's.
Arrangement two_balls(const Pose& pose, bool lens) {
  const Point a = pose.place({-4, 0, 0}), b = pose.place({8, 0, 0});
  const auto region = [=](const Point& p) {
    const bool in_a = distance(p, a) < 10, in_b = distance(p, b) < 8;
    return lens && in_a && in_b ? 3 : in_a ? 1 : in_b ? 2 : 0;
  };
  Curve circle;
  circle.origin = pose.place({-4 + 7.5, 0, 0});
  circle.u = pose.y;
  circle.v = pose.z;
  circle.radius = std::sqrt(100 - 7.5 * 7.5);
  circle.length = 2 * std::numbers::pi * circle.radius;
  return {{{true, a, 10}, {true, b, 8}}, region, {circle}, {}, pose.shift, 16.5};
}

/// A ball of radius 10 mm, region 1, with a slice cut off by a plane that meets the sphere at that angle, region 2.
Arrangement ball_with_slice(const Pose& pose, double angle) {
  const Point center = pose.shift;
  const double height = 10 * std::cos(angle);
  const Vec up = pose.x;
  const auto region = [=](const Point& p) {
    return distance(p, center) >= 10 ? 0 : dot(up, p - center) > height ? 2 : 1;
  };
  Curve circle;
  circle.origin = center + height * up;
  circle.u = pose.y;
  circle.v = pose.z;
  circle.radius = 10 * std::sin(angle);
  circle.length = 2 * std::numbers::pi * circle.radius;
  return {{{true, center, 10}, {false, up, dot(up, center) + height}}, region, {circle}, {}, center, 10};
}

/// The arc of a sphere on the plane between two sites, from one corner to another: of the two the one where no other
/// site is nearer.
Curve arc(const Point& center, double sphere_radius, const Primitive& plane, const std::vector<Corner>& corners,
          int from, int to, const std::function<bool(const Point&)>& is_interface) {
  Curve curve;
  const double height = plane.offset_or_radius - dot(plane.normal_or_center, center);
  curve.origin = center + height * plane.normal_or_center;
  curve.radius = std::sqrt(sphere_radius * sphere_radius - height * height);
  curve.u = unit(corners[from].point - curve.origin);
  curve.v = cross(plane.normal_or_center, curve.u);
  const Vec end = corners[to].point - curve.origin;
  double angle = std::atan2(dot(end, curve.v), dot(end, curve.u));
  if (angle < 0) angle += 2 * std::numbers::pi;
  curve.length = angle * curve.radius;
  if (!is_interface(curve.at(curve.length / 2))) {
    curve.v = -1 * curve.v;
    curve.length = (2 * std::numbers::pi - angle) * curve.radius;
  }
  curve.corner[0] = from;
  curve.corner[1] = to;
  return curve;
}

/// The Voronoi cells of four sites in a ball of radius 10 mm: they meet at a point in it, whence four curves lead to
/// its surface.
Arrangement four_cells(const Pose& pose) {
  const Point center = pose.shift, meeting = pose.place({1.5, 1, -0.8});
  const std::array<Vec, 4> towards{Vec{1, 0.9, 1.1}, Vec{1.1, -1, -0.8}, Vec{-0.9, 1, -1.2}, Vec{-1, -1.2, 0.9}};
  std::array<Point, 4> sites;
  for (int i = 0; i < 4; ++i) sites[i] = meeting + 5 * unit(pose.turn(towards[i]));
  const auto nearest = [sites](const Point& p) {
    int best = 0;
    for (int i = 1; i < 4; ++i)
      if (squared_distance(p, sites[i]) < squared_distance(p, sites[best])) best = i;
    return best;
  };
  const auto region = [=](const Point& p) { return distance(p, center) < 10 ? nearest(p) + 1 : 0; };
  std::vector<Primitive> primitives{{true, center, 10}};
  std::vector<Corner> corners;
  for (int i = 0; i < 4; ++i) {  // Where the curve of all sites but this one leaves the ball.
    const Point &p = sites[(i + 1) % 4], &q = sites[(i + 2) % 4], &r = sites[(i + 3) % 4];
    Vec along = unit(cross(q - p, r - p));
    if (dot(along, p - sites[i]) < 0) along = -1 * along;
    const double b = dot(along, meeting - center);
    corners.push_back({meeting + (-b + std::sqrt(b * b + 100 - squared_distance(meeting, center))) * along, 0});
  }
  corners.push_back({meeting, 0});
  std::vector<Curve> curves;
  curves.reserve(10);
  for (int i = 0; i < 4; ++i) curves.push_back(segment(corners, 4, i));
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) {
      const Vec normal = unit(sites[j] - sites[i]);
      primitives.push_back({false, normal, dot(normal, 0.5 * (sites[i] + sites[j]))});
      int others[2], count = 0;
      for (int k = 0; k < 4; ++k)
        if (k != i && k != j) others[count++] = k;
      curves.push_back(arc(center, 10, primitives.back(), corners, others[0], others[1], [&](const Point& p) {
        const int at = nearest(p);
        return at == i || at == j;
      }));
    }
  }
  return {primitives, region, curves, corners, center, 10};
}

}  // namespace

std::vector<NamedCase> all_cases() {
  constexpr double kSharp = 20 * std::numbers::pi / 180;
  return {
      {"cube",
       [](unsigned seed) {
         return parallelepiped(Pose(seed), {Vec{20, 0, 0}, Vec{0, 20, 0}, Vec{0, 0, 20}});
       }},
      {"two balls", [](unsigned seed) { return two_balls(Pose(seed), false); }},
      {"two balls and their lens", [](unsigned seed) { return two_balls(Pose(seed), true); }},
      {"four cells", [](unsigned seed) { return four_cells(Pose(seed)); }},
      {"ball and slice, 30 degrees", [](unsigned seed) { return ball_with_slice(Pose(seed), kSharp * 1.5); }},
      {"plate of 0.5 mm",
       [](unsigned seed) {
         return parallelepiped(Pose(seed), {Vec{20, 0, 0}, Vec{0, 20, 0}, Vec{0, 0, 0.5}});
       }},
      {"sheared cube, 20 degrees",
       [](unsigned seed) {
         return parallelepiped(Pose(seed),
                               {Vec{20, 0, 0}, Vec{0, 20, 0}, Vec{20 * std::cos(kSharp), 0, 20 * std::sin(kSharp)}});
       }},
  };
}

}  // namespace scantet::bench
