// The level zero, and what brings heights to the other side of it.
#pragma once

#include "scantet/field/level_settings.h"

namespace scantet::test {

inline const LevelSetSettings kAtZero{0, InsideSide::above, -1.0};

inline double opposite(double height) {
  return -height;
}

}  // namespace scantet::test
