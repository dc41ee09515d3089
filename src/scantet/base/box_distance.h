// How far a point is from a box.
#pragma once

#include <algorithm>

#include "scantet/base/geometry.h"

namespace scantet {

/// From p to the nearest point of the box, squared; 0 if p is in it, infinite if the box is empty.
inline double squared_distance(const Box& box, const Point& p) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double off = std::max(std::max(box.min[axis] - p[axis], p[axis] - box.max[axis]), 0.0);
    sum += off * off;
  }
  return sum;
}

}  // namespace scantet
