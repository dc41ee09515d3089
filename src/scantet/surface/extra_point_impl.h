// Private: a point that the topology of the boundary asks for.
#pragma once

#include "scantet/base/geometry.h"

namespace scantet::engine {

/// A point of ∂O to insert beside the rules, unless a vertex is nearer than clear_mm.
struct ExtraPoint {
  Point point;
  double clear_mm;
};

}  // namespace scantet::engine
