// Domains of several regions between planes and spheres, with their junction curves and corners: everything about them
// is known exactly.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "scantet/base/geometry.h"

namespace scantet::bench {

/// A plane (value: dot(normal, p) - offset) or a sphere (value: distance from its centre less its radius); mm.
struct Primitive {
  bool is_sphere = false;
  Vec normal_or_center;
  double offset_or_radius = 0;
};

/// A set of patches, one bit each.
using Patches = std::uint64_t;

/// Where a segment passes from one region to another. A patch is a primitive between one pair of regions.
struct Crossing {
  Point point;
  int patch = 0;
};

/// A segment, an arc or a circle by its arc length s, from 0 to length, mm.
struct Curve {
  Point origin;              ///< a segment's start, an arc's centre
  Vec u;                     ///< a segment's unit direction; an arc's first axis
  Vec v;                     ///< an arc's second axis
  double radius = 0;         ///< 0: a segment
  double length = 0;         ///< mm
  int corner[2] = {-1, -1};  ///< at s = 0 and s = length; -1 both: closed
  Patches patches = 0;       ///< that meet here, filled in by the arrangement
  int sheets = 0;            ///< how many patches leave the curve

  bool closed() const { return corner[0] < 0; }
  Point at(double s) const;
};

struct Corner {
  Point point;
  Patches patches = 0;
};

class Arrangement {
 public:
  /// region: of a point, 0 outside; changes on primitives only. Everything is within radius_mm of center.
  Arrangement(std::vector<Primitive> primitives, std::function<int(const Point&)> region, std::vector<Curve> curves,
              std::vector<Corner> corners, Point center, double radius_mm);

  int region_at(const Point& p) const { return region_(p); }
  /// All changes of region along the segment, in order.
  std::vector<Crossing> crossings(Point a, Point b) const;

  const std::vector<Curve>& curves() const { return curves_; }
  const std::vector<Corner>& corners() const { return corners_; }
  Point center() const { return center_; }
  double radius() const { return radius_; }

 private:
  int patch(int primitive, int a, int b) const;
  void find_patches_around(Curve& curve) const;

  std::vector<Primitive> primitives_;
  std::function<int(const Point&)> region_;
  std::vector<Curve> curves_;
  std::vector<Corner> corners_;
  Point center_;
  double radius_;
  mutable std::map<int, int> patch_ids_;  ///< numbered as they are met
};

/// A named domain, turned and shifted by a rotation of that seed.
struct NamedCase {
  std::string name;
  std::function<Arrangement(unsigned seed)> make;
};
std::vector<NamedCase> all_cases();

inline Vec unit(const Vec& v) {
  return (1 / length(v)) * v;
}

}  // namespace scantet::bench
