// The one gate between index space (voxel units) and world space (mm).
#pragma once

#include <array>

#include "scantet/base/api.h"
#include "scantet/base/geometry.h"

namespace SCANTET_API scantet {

/// An affine map from image index to world: world = origin + i·column(0) + j·column(1) + k·column(2).
/// Spacing, direction cosines and shear are all in the columns; flips (negative determinant) are allowed.
class Frame {
 public:
  /// Index space itself: 1 mm voxels, no rotation, origin at zero.
  Frame() = default;

  /// columns: world displacement of one index step along each axis, mm. origin: world position of index (0, 0, 0), mm.
  /// Throws Error: input.frame (a number is not finite, the columns are linearly dependent or nearly so, or one is more
  /// than 1e9 times as long as another).
  Frame(const std::array<Vec, 3>& columns, const Point& origin);

  /// index: of a point, in steps from voxel centre (0, 0, 0). Return: world mm.
  Point to_world(const Vec& index) const {
    return {origin_.x + columns_[0].x * index.x + columns_[1].x * index.y + columns_[2].x * index.z,
            origin_.y + columns_[0].y * index.x + columns_[1].y * index.y + columns_[2].y * index.z,
            origin_.z + columns_[0].z * index.x + columns_[1].z * index.y + columns_[2].z * index.z};
  }
  /// The inverse of to_world(), to rounding.
  Vec to_index(const Point& world) const {
    const Vec d = world - origin_;
    return {dot(rows_[0], d), dot(rows_[1], d), dot(rows_[2], d)};
  }

  /// World displacement of one index step along an axis, mm. axis: 0, 1 or 2, as of spacing_mm().
  const Vec& column(int axis) const { return columns_[axis]; }
  /// World position of index (0, 0, 0), mm.
  const Point& origin() const { return origin_; }
  /// Length of one index step along an axis, mm.
  double spacing_mm(int axis) const { return length(columns_[axis]); }
  /// The shortest distance between neighbouring voxel centres along the axes, mm.
  double min_spacing_mm() const { return std::min({spacing_mm(0), spacing_mm(1), spacing_mm(2)}); }
  /// Signed volume of a voxel, mm³; negative for a left-handed frame.
  double determinant_mm3() const { return dot(columns_[0], cross(columns_[1], columns_[2])); }
  /// The smallest world box, mm, around the index box from lo to hi.
  Box world_box(const Vec& lo, const Vec& hi) const;
  /// The smallest box of continuous indices around a world box.
  Box index_box(const Box& box) const;

 private:
  std::array<Vec, 3> columns_{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};
  std::array<Vec, 3> rows_{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};  // of the inverse
  Point origin_;
};

}  // namespace scantet
