// Private to check/: parts of the cells that a surface of a domain may be in.
#pragma once

#include <array>
#include <optional>

#include "scantet/base/trilinear.h"
#include "scantet/domain/boundary_cells.h"

namespace scantet {

/// A box in a cell, in the cell's local coordinates.
class BoundaryBox {
 public:
  /// The whole of a cell. cell: outlives the box.
  explicit BoundaryBox(const BoundaryCell& cell);

  /// A part of a surface that may be in the box lies in the convex hull of some points: their count and places.
  struct Hull {
    std::array<Point, 32> points;  // 8 corners and 2 on each of 12 edges at most
    std::size_t count = 0;

    Point middle() const;
    /// Of the points from p.
    double farthest_mm(const Point& p) const;
  };

  const BoundaryCell& cell() const { return *cell_; }
  /// Its edge, as a share of the cell's.
  double size() const { return size_; }
  /// Half its longest diagonal, mm.
  double half_diagonal_mm() const { return size_ * cell_half_diagonal_mm_; }
  Point center() const { return to_world(low_ + 0.5 * Vec{size_, size_, size_}); }

  /// Whether some of the surface may be in it; false is certain.
  bool may_hold(const BoundaryCells& cells, std::size_t surface) const;
  /// A point of the surface in it, mm; none if none was found.
  std::optional<Point> witness(const BoundaryCells& cells, std::size_t surface) const;
  /// Only if may_hold().
  Hull hull() const;
  /// One of its eight halves.
  BoundaryBox part(int corner) const;
  /// At least that far is p from all of the box, mm.
  double least_distance_mm(const Point& p) const;

 private:
  Point to_world(const Vec& local) const {
    return cell_->corner + local.x * cell_->edges[0] + local.y * cell_->edges[1] + local.z * cell_->edges[2];
  }
  Vec high() const { return low_ + Vec{size_, size_, size_}; }

  const BoundaryCell* cell_;
  Vec low_;
  double size_;
  CellHeights heights_;        // at its own corners
  std::array<Vec, 3> across_;  // their products with an offset are its shares of the cell's edges
  double cell_half_diagonal_mm_;
  bool right_angled_;  // the cell is
};

}  // namespace scantet
