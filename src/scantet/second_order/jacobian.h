// The Jacobian determinant of a ten-node tet: a polynomial of degree 3, held by its 20 Bezier coefficients (A. Johnen,
// J.-F. Remacle, C. Geuzaine: Geometrical validity of curvilinear finite elements, 2013).
#pragma once

#include <array>

#include "scantet/base/element_nodes.h"
#include "scantet/base/geometry.h"

namespace scantet {

/// Corners, then the nodes on the edges 01, 12, 02, 03, 13, 23; world mm.
using TetNodes = std::array<Point, 10>;

/// The determinant as a Bezier polynomial in barycentric coordinates. It lies between the least and the greatest
/// coefficient. Of straight edges with nodes in their middles all coefficients are six times the volume.
class TetJacobian {
 public:
  explicit TetJacobian(const TetNodes& nodes);

  /// What a coefficient is off at the most, by rounding, mm³.
  double error_mm3() const { return error_mm3_; }

  /// Volume of the element, mm³: the integral of the determinant.
  double volume_mm3() const;

  /// Whether the determinant is proved to be greater than `least_mm3` in the whole element: by the coefficients, and
  /// where they do not tell, by those of halves, up to a depth.
  bool is_above(double least_mm3) const;

  /// A bound that the determinant is proved not to be below, mm³: the least coefficient less the error.
  double lower_bound_mm3() const;

 private:
  std::array<double, 20> coefficients_{};
  double error_mm3_ = 0;
};

}  // namespace scantet
