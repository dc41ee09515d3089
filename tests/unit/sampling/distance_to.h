// How far it is from a place to the nearest of points.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "scantet/base/geometry.h"

namespace scantet::test {

inline double distance_to(const std::vector<Point>& points, const Point& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Point& q : points) nearest = std::min(nearest, distance(p, q));
  return nearest;
}

}  // namespace scantet::test
