// The finished mesh: plain arrays.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scantet/base/geometry.h"

namespace scantet {

/// Which part of the domain a point is in; 0 is outside.
using Region = std::int32_t;
inline constexpr Region kOutside = 0;

using VertexId = std::uint32_t;
using Tet = std::array<VertexId, 4>;
using Triangle = std::array<VertexId, 3>;

/// A tetrahedral mesh with its boundary.
///
/// Guarantees of a mesh made by scantet (the audit in quality/ checks them): tets are positively oriented
/// (det(b-a, c-a, d-a) > 0); every vertex belongs to a tet; a boundary facet lies between two regions, appears once and
/// is oriented so that its right-hand normal points out of facet_regions[i][0] into facet_regions[i][1].
struct TetMesh {
  std::vector<Point> vertices;                       ///< world mm (LPS for images)
  std::vector<Tet> tets;                             ///< four vertex ids each
  std::vector<Region> tet_regions;                   ///< one per tet, never kOutside
  std::vector<Triangle> boundary_facets;             ///< three vertex ids each
  std::vector<std::array<Region, 2>> facet_regions;  ///< {behind, in front}; behind is never kOutside
  std::vector<std::uint8_t> on_boundary;             ///< one per vertex: 1 if a boundary facet has it
};

/// Six times the signed volume of the tet (a, b, c, d); positive if positively oriented.
inline double orientation_mm3(const Point& a, const Point& b, const Point& c, const Point& d) {
  return dot(b - a, cross(c - a, d - a));
}

}  // namespace scantet
