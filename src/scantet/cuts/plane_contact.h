// Planes that go along the boundary of what they cut.
#pragma once

#include <cstddef>

#include "scantet/cuts/cut_space.h"

namespace scantet {

/// Whether a corner or a curve of the domain, or some of its boundary, lies in a plane: then what meets what there is a
/// matter of rounding. Curves are looked at in seven places, the plane in 3,600.
/// near_mm: ≥ 0, what is as near is in the plane.
bool touches_boundary(const CutSpace& space, std::size_t plane, double near_mm);

}  // namespace scantet
