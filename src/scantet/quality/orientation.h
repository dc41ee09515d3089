// The exact sign of a tet's volume.
#pragma once

#include "scantet/base/geometry.h"

namespace scantet {

/// 1 if the tet (a, b, c, d) is positively oriented (det(b-a, c-a, d-a) > 0), -1 if negatively, 0 if its corners lie in
/// one plane. Exact for finite coordinates of magnitude 1e-80 … 1e80 (or zero): no product under- or overflows.
int orientation_sign(const Point& a, const Point& b, const Point& c, const Point& d);

}  // namespace scantet
