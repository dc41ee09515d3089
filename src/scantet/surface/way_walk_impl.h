// Private: the cells of the triangulation along a way.
#pragma once

#include <algorithm>

#include "scantet/delaunay/inserter_impl.h"

namespace scantet::engine {

/// Goes along segments from cell to cell. Where a cell ends is worked out in doubles, and which one is next looked for
/// a little further on, so that neither rounding nor a way along a face leads astray.
class WayWalk {
 public:
  /// start: a cell, from which the first way is looked for.
  WayWalk(Triangulation& t, CellId start) : t_(t), inserter_(t), at_(start) {}

  /// Calls take(cell, place) for each cell that has more of the segment than a 10,000th of it, and maybe for others
  /// that it meets, with a place in the cell and on the segment.
  template <class Take>
  void run(const Segment& way, const Take& take) {
    double share = 0;
    while (true) {
      const Point place = share < 1 ? lerp(way.source, way.target, share) : way.target;
      at_ = inserter_.cell_at(place, at_);
      take(at_, place);
      if (share >= 1) return;
      share = std::min(1.0, std::max(share, end_in_cell(way)) + kShortest);
    }
  }
  /// The next look begins at that cell.
  void go_to(CellId cell) { at_ = cell; }

 private:
  static constexpr double kShortest = 1e-4;  // of the way: threads have gaps that are hardly wider

  /// The share of the way at which it leaves the cell where it is; 1 if it ends there.
  double end_in_cell(const Segment& way) const {
    const std::array<Point, 4> p = t_.points_of(at_);
    const Vec along = way.target - way.source;
    double end = 1;
    for (std::size_t i = 0; i < 4; ++i) {
      const Point& base = p[(i + 1) % 4];
      Vec normal = cross(p[(i + 2) % 4] - base, p[(i + 3) % 4] - base);
      if (dot(normal, p[i] - base) < 0) normal = -1 * normal;
      const double fall = -dot(normal, along);
      if (fall > 0) end = std::min(end, dot(normal, way.source - base) / fall);
    }
    return end;
  }

  Triangulation& t_;
  Inserter inserter_;
  CellId at_;
};

}  // namespace scantet::engine
