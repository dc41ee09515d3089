// Planes that cut an object.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/frame.h"
#include "scantet/base/geometry.h"

namespace SCANTET_API scantet {

/// A plane; what lies on it or beyond is cut off.
struct CutPlane {
  Vec normal;        ///< of unit length, towards what is cut off
  double offset_mm;  ///< of the plane from the origin along the normal
  std::string name;  ///< of the patch that the cut leaves, "border_left"; not empty

  /// For the border of a grid of voxels, whose field ends within one voxel beyond: how far, mm. Such a cut leaves the
  /// topology of the object as it is. Zero for other planes.
  Vec closing_mm{};

  /// Whether it is the border of a grid.
  bool is_border() const { return closing_mm != Vec{}; }
  /// How far p is beyond the plane, mm; negative on the side that is kept.
  double beyond_mm(const Point& p) const { return dot(normal, p) - offset_mm; }
  /// The point of the plane that is nearest to p, to a rounding error of its coordinates.
  Point nearest(const Point& p) const;
};

/// The six faces of the box of a grid's voxel centres, named by what lies beyond them in a world of LPS axes:
/// border_left, border_right, border_anterior, border_posterior, border_superior, border_inferior. Of a grid whose axes
/// are not those of the world, each face has the name of the direction that it faces most, so that no two have one.
/// frame: index to world. first, last: voxels of the grid, at opposite corners, first the lower one along each axis.
/// Return: six, axis by axis of the grid, the face at `first` before that at `last`; is_border() holds of each.
std::vector<CutPlane> border_planes(const Frame& frame, const std::array<int, 3>& first,
                                    const std::array<int, 3>& last);
/// Of the voxels from (0, 0, 0) on, size of them along each axis.
std::vector<CutPlane> border_planes(const Frame& frame, const std::array<int, 3>& size);

}  // namespace scantet
