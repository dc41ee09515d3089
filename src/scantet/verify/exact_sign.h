// Signs of differences of products and of determinants, without error.
#pragma once

#include "scantet/base/geometry.h"

namespace scantet::verify {

/// The sign of det(b - a, c - a, d - a): 1 if the tet (a, b, c, d) is positively oriented, 0 if its corners lie in a
/// plane. Exact for coordinates of absolute value between 1e-60 and 1e60, or 0.
int orientation(const Point& a, const Point& b, const Point& c, const Point& d);

/// The sign of the same in the plane of y and z: 1 if a, b, c turn to the left, looking against x.
int orientation_yz(const Point& a, const Point& b, const Point& c);

/// The sign of (a - o)·(d - o) - (b - o)·(c - o). Exact within the same limits.
int sign_of_saddle(double a, double d, double b, double c, double o);

}  // namespace scantet::verify
