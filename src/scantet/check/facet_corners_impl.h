// Private to check/: a mesh's facets as triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include "scantet/base/tet_mesh.h"

namespace scantet {

/// A triangle by its corners.
using FacetCorners = std::array<Point, 3>;

/// Of mesh.boundary_facets[facet].
inline FacetCorners corners_of(const TetMesh& mesh, std::size_t facet) {
  const Triangle& t = mesh.boundary_facets[facet];
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

/// The places in mesh.boundary_facets of all there are.
inline std::vector<std::uint32_t> all_facets(const TetMesh& mesh) {
  std::vector<std::uint32_t> facets(mesh.boundary_facets.size());
  std::iota(facets.begin(), facets.end(), 0U);
  return facets;
}

inline Point centroid_of(const FacetCorners& t) {
  return 1.0 / 3 * (t[0] + t[1] + t[2]);
}

/// The distance from a point to the farthest of the corners.
inline double farthest_corner_mm(const FacetCorners& t, const Point& p) {
  return std::max({distance(t[0], p), distance(t[1], p), distance(t[2], p)});
}

/// The right-hand normal, as long as twice the area.
inline Vec area_normal(const FacetCorners& t) {
  return cross(t[1] - t[0], t[2] - t[0]);
}

/// A vector of a length along the right-hand normal; along z if the triangle has no area.
inline Vec along_normal(const FacetCorners& t, double length_mm) {
  const Vec normal = area_normal(t);
  const double norm = length(normal);
  return norm > 0 ? length_mm / norm * normal : Vec{0, 0, length_mm};
}

}  // namespace scantet
