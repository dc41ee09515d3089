// The inverse is kept as rows of reciprocal vectors, so that a query costs nine multiplications and no solve.
#include "scantet/base/frame.h"

#include <algorithm>
#include <cmath>

#include "scantet/base/error.h"

namespace scantet {

Frame::Frame(const std::array<Vec, 3>& columns, const Point& origin) : columns_(columns), origin_(origin) {
  const double volume = determinant_mm3();
  const double box = spacing_mm(0) * spacing_mm(1) * spacing_mm(2);
  constexpr double kSmallestSine3 = 1e-6;  // flatter parallelepipeds are a broken header, not a scan
  const bool finite = is_finite(columns[0]) && is_finite(columns[1]) && is_finite(columns[2]) && is_finite(origin);
  if (!finite || !(box > 0) || !(std::abs(volume) > kSmallestSine3 * box)) {
    throw Error(Fault::input, "input.frame", "the image's axes do not span space (zero, infinite or parallel steps)",
                "correct spacing and direction in the header");
  }
  constexpr double kMostDifferent = 1e9;  // with 1e15 and more, coordinates do not have the digits for the shorter step
  if (std::max({spacing_mm(0), spacing_mm(1), spacing_mm(2)}) > kMostDifferent * min_spacing_mm()) {
    throw Error(Fault::input, "input.frame", "the image's steps along its axes differ by more than 1e9 times",
                "correct the spacing in the header");
  }
  rows_ = {(1 / volume) * cross(columns[1], columns[2]), (1 / volume) * cross(columns[2], columns[0]),
           (1 / volume) * cross(columns[0], columns[1])};
}

Box Frame::world_box(const Vec& lo, const Vec& hi) const {
  Box box;
  for (int n = 0; n < 8; ++n) box.extend(to_world(Box{lo, hi}.corner(n)));
  return box;
}

Box Frame::index_box(const Box& box) const {
  Box indices;
  for (int n = 0; n < 8; ++n) indices.extend(to_index(box.corner(n)));
  return indices;
}

}  // namespace scantet
