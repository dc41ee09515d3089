// What can be measured of one tet or one triangle.
#pragma once

#include <array>

#include "scantet/base/geometry.h"

namespace scantet {

/// The edges of a tet as pairs of its corners; edge i and edge 5 - i are opposite.
inline constexpr std::array<std::array<int, 2>, 6> kTetEdges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// Products of coordinates up to this size do not overflow.
inline constexpr double kLargestCoordinateMm = 1e60;

/// The measures of one tet. For a flat one (volume zero as computed): dihedral angles 0° or 180°, circumradius and
/// radius_edge infinite, inverse_aspect, scaled_jacobian and min_height_mm 0, no circumcentre (0, 0, 0). Never NaN for
/// coordinates up to kLargestCoordinateMm.
struct TetMeasures {
  double volume_mm3;                   ///< signed: positive if positively oriented
  std::array<double, 6> dihedral_deg;  ///< inner angle at each of kTetEdges, 0 … 180
  std::array<double, 6> edge_mm;       ///< length of each of kTetEdges
  Point circumcentre;                  ///< world mm
  double circumradius_mm;
  double radius_edge;     ///< circumradius / shortest edge; √6/4 (regular) … infinity
  double inverse_aspect;  ///< inradius / circumradius, not normalised; 0 (flat) … 1/3 (regular)
  /// √2 · 6 · volume / the largest product of the three edges at a corner, as Verdict and VTK define it; signed as the
  /// volume: 0 (flat) … 1 (regular) if positively oriented.
  double scaled_jacobian;
  double min_height_mm;  ///< the least distance of a corner from the plane of the others: 3 |volume| / largest face
};

/// Corners in world mm, of either orientation.
TetMeasures measure_tet(const Point& a, const Point& b, const Point& c, const Point& d);

/// How much larger the largest eigenvalue of a tet's stiffness matrix is for the tet's shape: that of the Laplace
/// operator with linear elements, over that of the regular tet of the same volume; 1 (regular) … infinity (flat). As
/// the eigenvalue of a shape grows with the length of its edges, this does not depend on the size. After Shewchuk, What
/// is a good linear element? (2002), section 3, where the eigenvalue bounds that of the whole stiffness matrix. Corners
/// in world mm, of either orientation; never NaN for coordinates up to kLargestCoordinateMm.
double stiffness_ratio(const Point& a, const Point& b, const Point& c, const Point& d);

/// The inner angles at a, b and c, degrees. 0° or 180° where the triangle is degenerate.
std::array<double, 3> triangle_angles_deg(const Point& a, const Point& b, const Point& c);

}  // namespace scantet
