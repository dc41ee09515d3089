// Private: Poisson-disk samples by throwing darts.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/base/geometry.h"

namespace scantet::refine {

/// A point and the distance it must have to the darts kept before it, mm.
struct Dart {
  Point point;
  double radius_mm;
  bool fixed = false;  ///< not to be moved afterwards
};

/// Throws the darts in order: one is kept if no dart kept before it is nearer than `share` of its radius. Several
/// threads; the result is that of throwing one dart after the other.
/// Return: the kept darts in their order.
std::vector<Dart> throw_darts(const std::vector<Dart>& darts, double share);

}  // namespace scantet::refine
