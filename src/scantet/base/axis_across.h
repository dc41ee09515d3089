// An axis that is not along a direction, to begin a frame with.
#pragma once

#include <cmath>

#include "scantet/base/geometry.h"

namespace scantet {

/// Of length 1, along the axis that a direction other than 0 has the least of; of several the first.
inline Vec axis_across(const Vec& direction) {
  int least = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (std::abs(direction[axis]) < std::abs(direction[least])) least = axis;
  }
  Vec across;
  across[least] = 1;
  return across;
}

}  // namespace scantet
