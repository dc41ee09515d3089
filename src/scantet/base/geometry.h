// Points, vectors, segments and boxes in world space. All lengths are millimetres unless a name says otherwise.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scantet/base/api.h"

namespace SCANTET_API scantet {

/// Three numbers: a displacement in mm, or in voxels where a name says index.
struct Vec {
  double x = 0;
  double y = 0;
  double z = 0;

  /// axis: 0, 1 or 2.
  double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  /// axis: 0, 1 or 2.
  double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  friend bool operator==(const Vec&, const Vec&) = default;
};

/// A position in world space, mm. A Vec by another name: the arithmetic is the same.
using Point = Vec;

inline Vec operator+(const Vec& a, const Vec& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec operator-(const Vec& a, const Vec& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec operator*(double s, const Vec& v) {
  return {s * v.x, s * v.y, s * v.z};
}
inline double dot(const Vec& a, const Vec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double squared_length(const Vec& v) {
  return dot(v, v);
}
inline double length(const Vec& v) {
  return std::sqrt(squared_length(v));
}
inline double squared_distance(const Point& a, const Point& b) {
  return squared_length(a - b);
}
inline double distance(const Point& a, const Point& b) {
  return length(a - b);
}
/// a at t = 0, b at t = 1 (to rounding), and on along their line for other t.
inline Point lerp(const Point& a, const Point& b, double t) {
  return a + t * (b - a);
}
inline bool is_finite(const Vec& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// x, then y, then z: a total order that depends on geometry only.
inline bool lexicographically_less(const Point& a, const Point& b) {
  if (a.x != b.x) return a.x < b.x;
  return a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// A straight line from one point to another; it has a direction.
struct Segment {
  Point source;
  Point target;
};

/// Axis-aligned box. A default-constructed box is empty: it contains nothing and any point extends it.
struct Box {
  Point min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
            std::numeric_limits<double>::infinity()};
  Point max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
            -std::numeric_limits<double>::infinity()};

  /// Whether it contains nothing; so does one with a NaN.
  bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  /// Makes it the smallest box around itself and p; a coordinate that is NaN changes nothing.
  void extend(const Point& p) {
    for (int axis = 0; axis < 3; ++axis) {
      min[axis] = std::min(min[axis], p[axis]);
      max[axis] = std::max(max[axis], p[axis]);
    }
  }
  /// Makes it the smallest box around itself and another.
  void unite(const Box& other) {
    for (int axis = 0; axis < 3; ++axis) {
      min[axis] = std::min(min[axis], other.min[axis]);
      max[axis] = std::max(max[axis], other.max[axis]);
    }
  }
  /// By so much larger on every side.
  Box grown(double by_mm) const { return {min - Vec{by_mm, by_mm, by_mm}, max + Vec{by_mm, by_mm, by_mm}}; }
  /// Whether they have a point in common; an empty box has none.
  bool meets(const Box& other) const {
    return min.x <= other.max.x && other.min.x <= max.x && min.y <= other.max.y && other.min.y <= max.y &&
           min.z <= other.max.z && other.min.z <= max.z;
  }
  /// n: 0 to 7; bit 0, 1 or 2 is set where it is the upper one in x, y or z.
  Point corner(int n) const { return {n & 1 ? max.x : min.x, n & 2 ? max.y : min.y, n & 4 ? max.z : min.z}; }
  /// Whether p is in it or on its surface.
  bool contains(const Point& p) const {
    return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y && p.z >= min.z && p.z <= max.z;
  }
  /// Halfway between its corners. Pre: not empty, as of the next two.
  Point center() const { return 0.5 * (min + max); }
  /// Lengths of its edges, mm.
  Vec extent() const { return max - min; }
  /// Length of its diagonal, mm.
  double diagonal() const { return length(extent()); }
};

}  // namespace scantet
