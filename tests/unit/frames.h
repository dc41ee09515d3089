// Frames for tests of scans.
#pragma once

#include <cmath>

#include "scantet/base/frame.h"

namespace scantet::test {

inline Frame plain() {
  return {};
}

inline Frame oblique() {
  const double c = std::cos(0.4);
  const double s = std::sin(0.4);
  return Frame({Vec{0.8 * c, 0.8 * s, 0}, Vec{-1.3 * s, 1.3 * c, 0.1}, Vec{0, -0.2, 2.1}}, {-310, 420, -150});
}

inline Frame flipped_and_sheared() {
  return Frame({Vec{-1, 0, 0}, Vec{0.3, 0.7, 0}, Vec{0, 0.4, 1.2}}, {50, -40, 1000});
}

}  // namespace scantet::test
