// A lattice of points whose Delaunay triangulation is known.
#pragma once

#include "scantet/base/geometry.h"

namespace scantet {

/// A body-centred cubic lattice: the corners and centres of cubes.
struct SeedLattice {
  Point corner;
  double side_mm = 0;  ///< of a cube
};

}  // namespace scantet
