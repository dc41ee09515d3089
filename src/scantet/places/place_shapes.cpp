#include "scantet/places/place_shapes.h"

#include <cmath>

#include "scantet/base/error.h"

namespace scantet {
namespace {

/// Of a signed measure, at most 0 inside.
Hit hit_of(double outside, Hit::Unit unit = Hit::Unit::mm) {
  return {std::abs(outside), outside <= 0, unit};
}

double outside_box(const std::vector<double>& n, const Point& p) {
  Vec beyond;
  double deepest = -std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double past = std::max(n[a] - p[axis], p[axis] - n[a + 3]);
    beyond[axis] = std::max(past, 0.0);
    deepest = std::max(deepest, past);
  }
  return deepest <= 0 ? deepest : length(beyond);
}

double outside_cylinder(const std::vector<double>& n, const Point& p) {
  const Point first{n[0], n[1], n[2]};
  const Vec axis = Point{n[3], n[4], n[5]} - first;
  const double long_mm = length(axis);
  const double along = dot(p - first, axis) / long_mm;
  const double around = length((p - first) - (along / long_mm) * axis) - n[6];
  const double past = std::max(-along, along - long_mm);
  if (around <= 0 && past <= 0) return std::max(around, past);
  return std::hypot(std::max(around, 0.0), std::max(past, 0.0));
}

}  // namespace

Hit hit_of_both(const Hit& a, const Hit& b) {
  if (a.is_in && b.is_in) return a.miss < b.miss ? a : b;
  if (a.is_in) return b;
  if (b.is_in) return a;
  return a.miss > b.miss ? a : b;
}

Hit hit_of_either(const Hit& a, const Hit& b) {
  return hit_of_complement(hit_of_both(hit_of_complement(a), hit_of_complement(b)));
}

Hit hit_of_complement(Hit hit) {
  hit.is_in = !hit.is_in;
  return hit;
}

Hit hit_of_shape(const Place& place, const ScanTable& scans, const Point& p) {
  const std::vector<double>& n = place.numbers;
  switch (place.kind) {
    case Place::Kind::everything:
      return {std::numeric_limits<double>::infinity(), true, Hit::Unit::mm};
    case Place::Kind::box:
      return hit_of(outside_box(n, p));
    case Place::Kind::ball:
      return hit_of(distance(p, {n[0], n[1], n[2]}) - n[3]);
    case Place::Kind::cylinder:
      return hit_of(outside_cylinder(n, p));
    case Place::Kind::planes: {
      Hit hit{std::numeric_limits<double>::infinity(), true, Hit::Unit::mm};
      for (const CutPlane& plane : place.planes) hit = hit_of_both(hit, hit_of(plane.beyond_mm(p)));
      return hit;
    }
    case Place::Kind::above:
      return hit_of(n[0] - scans.at(place.name).at(p), Hit::Unit::value);
    case Place::Kind::below:
      return hit_of(scans.at(place.name).at(p) - n[0], Hit::Unit::value);
    default:
      throw Error(Fault::internal, "internal.place", "a place that points alone do not tell");
  }
}

bool is_point_in(const Place& place, const ScanTable& scans, const Point& p) {
  const auto is_in = [&](const Place& part) { return is_point_in(part, scans, p); };
  switch (place.kind) {
    case Place::Kind::all_of:
      return std::all_of(place.parts.begin(), place.parts.end(), is_in);
    case Place::Kind::any_of:
      return std::any_of(place.parts.begin(), place.parts.end(), is_in);
    case Place::Kind::not_in:
      return !is_in(place.parts.front());
    default:
      return hit_of_shape(place, scans, p).is_in;
  }
}

}  // namespace scantet
