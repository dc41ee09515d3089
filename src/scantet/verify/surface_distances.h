// How far two surfaces of triangles are from each other, between bounds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/verify/box_tree.h"

namespace scantet::verify {

/// Triangles, and which of them is nearest.
class TriangleSet {
 public:
  /// points: must outlive it. triangles: at least one.
  TriangleSet(const std::vector<Point>& points, std::vector<Triangle> triangles);

  std::size_t count() const { return triangles_.size(); }
  std::array<Point, 3> corners(std::size_t triangle) const;
  struct Nearest {
    std::uint32_t triangle = 0;
    double distance_mm = 0;
  };
  /// The nearest triangle, to rounding, and how far it is.
  Nearest nearest(const Point& p) const;
  /// How far a point of the triangle is, the nearest one to rounding.
  double distance_to(std::size_t triangle, const Point& p) const;
  /// No coordinate is larger.
  double largest_mm() const { return largest_mm_; }

 private:
  const std::vector<Point>& points_;
  std::vector<Triangle> triangles_;
  BoxTree tree_;
  double largest_mm_ = 0;
};

/// How far the points of a triangle are from another surface.
struct TriangleDistance {
  double lower_mm = 0;  ///< of a point of the triangle, to rounding
  Point lower_place;
  double upper_mm = 0;  ///< of all of its points: proved, with a margin for rounding
};

/// Of each triangle of `from`. Pieces are halved until they are known to within a tenth of the largest distance that is
/// found, or of a hundredth of scale_mm if that is more; if cancelled, the outcome means nothing.
/// scale_mm: the length of the finer surface's edges, say.
std::vector<TriangleDistance> surface_distances(const TriangleSet& from, const TriangleSet& to, double scale_mm,
                                                const Progress& progress);

}  // namespace scantet::verify
