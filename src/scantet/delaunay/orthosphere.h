// Spheres orthogonal to weighted points, as Delaunay triangulations of such points have them in place of circumspheres
// (Cheng, Dey, Shewchuk: Delaunay Mesh Generation, chapter 6). Without weights these are circumspheres.
#pragma once

#include <array>

#include "scantet/base/geometry.h"

namespace scantet::engine {

/// A point as a ball around it. Its power distance to x is |x - point|² - weight.
struct WeightedPoint {
  Point point;
  double weight = 0;  ///< the ball's radius, squared, mm²
};

/// The point with the same power distance to four weighted points in general position, mm: a function of the points
/// alone, whatever their order. In double precision; exactly (then rounded) where the points are close to a plane.
Point orthocentre(std::array<WeightedPoint, 4> tet);

inline constexpr double kFlat = 1e-9;  ///< relative determinant below which fewer than seven digits would be left

/// orthocentre() in double precision: NaN where that would not do, and last bits that depend on the order of the points
/// (none for points in lexicographic order). determinant: six times the volume, less some digits where the tet is flat.
Point quick_orthocentre(const std::array<WeightedPoint, 4>& tet, double& determinant);

/// The point in the plane of three weighted points with the same power distance to each, mm.
Point orthocentre(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c);

/// Radius of the orthogonal sphere around that point over the triangle's shortest edge; 0 where balls reach over it,
/// infinity if the triangle is degenerate.
double orthoradius_edge(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c);

/// Lexicographic order of the points.
void sort_points(std::array<WeightedPoint, 4>& tet);

}  // namespace scantet::engine
