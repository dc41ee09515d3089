// Private: a point that the topology of the boundary asks for.
#pragma once

#include "scantet/base/geometry.h"
#include "scantet/delaunay/triangulation_impl.h"

namespace scantet::engine {

/// A point of ∂O to insert beside the rules, unless a vertex is nearer than clear_mm.
struct ExtraPoint {
  Point point;
  double clear_mm;
  CellId near = kNone;  ///< a cell near by, from which to look for the point's zone; kNone: not known
};

/// The order in which they are inserted: the clearest first.
inline bool clearer(const ExtraPoint& a, const ExtraPoint& b) {
  return a.clear_mm != b.clear_mm ? a.clear_mm > b.clear_mm : lexicographically_less(a.point, b.point);
}

}  // namespace scantet::engine
