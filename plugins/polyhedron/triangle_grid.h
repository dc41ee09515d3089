// Which triangles of a surface lie where, and on which side of it a place is.
#pragma once

#include <optional>
#include <vector>

#include "scantet/domain/clearance_grid.h"
#include "surface.h"

namespace polyhedron {

inline Kernel::Point_3 to_cgal(const scantet::Point& p) {
  return {p.x, p.y, p.z};
}
inline scantet::Point from_cgal(const Kernel::Point_3& p) {
  return {p.x(), p.y(), p.z()};
}

/// The triangles in each cube of a grid, and the side of each cube's centre. Every answer is exact; the rare question
/// that needs more than signs, as a segment through an edge does, is left open. Immutable: safe to use from many
/// threads.
class TriangleGrid {
 public:
  using Triangle = std::array<Kernel::Point_3, 3>;
  using InsideTest = std::function<bool(const Kernel::Point_3&)>;

  /// is_inside: exact; asked where the grid's own triangles leave a centre's side open. box: holds the surface.
  TriangleGrid(const Surface& surface, const scantet::Box& box, const InsideTest& is_inside);

  /// Whether p is inside of the surface; nothing if that is left open.
  std::optional<bool> is_inside(const scantet::Point& p) const;

  /// The triangle nearest to p among those of its cube, by its number in the order of the surface's faces; nothing if
  /// there is none. A point on the surface, up to rounding, is on that one.
  std::optional<std::size_t> nearest_triangle(const scantet::Point& p) const;

  /// Overwrites `places` with those where the segment passes through the surface, ascending, as shares of its length;
  /// rounded, but exact in number. False if that is left open. The segment: no longer than a thousand boxes.
  bool find_passages(const scantet::Segment& segment, std::vector<double>& places) const;

 private:
  void sort_into_cubes(const scantet::CubeGrid& cubes);
  std::vector<scantet::CubeState> settle_centers(const scantet::CubeGrid& cubes, const InsideTest& is_inside);
  /// How often the segment passes through triangles of the two cubes, which may be the same, is odd.
  std::optional<bool> changes_side(const Kernel::Point_3& p, const Kernel::Point_3& q, std::size_t a,
                                   std::size_t b) const;

  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> first_;     // of each cube in in_cubes_, and the end
  std::vector<std::uint32_t> in_cubes_;  // triangles
  std::vector<char> center_inside_;
  scantet::ClearanceGrid clear_;
};

}  // namespace polyhedron
