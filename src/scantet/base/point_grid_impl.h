// Private: a fixed set of points, to be asked which of them are near a place.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/base/geometry.h"
#include "scantet/base/large_pages.h"
#include "scantet/base/parallel_buckets.h"

namespace scantet {

/// The points in rows parallel to the x axis, each row sorted by x. Its memory depends on the number of points only,
/// not on the size of space. Const methods may be called from many threads.
class PointGrid {
 public:
  struct Entry {
    Point point;
    std::uint32_t index;  ///< in the vector that the grid was made from
  };

  PointGrid() = default;

  /// row_mm: width of a row, mm; about the radius that will be asked for.
  PointGrid(const std::vector<Point>& points, double row_mm);

  /// Calls visit(index, point) for the points in the box, until it returns true; in an order that depends on the points
  /// and the box only, from the middle outward. Returns whether it did.
  template <class Visit>
  bool any_in(const Box& box, Visit visit) const {
    if (entries_.empty()) return false;
    const Point middle = box.center();
    return any_from(row_z(box.min.z), row_z(middle.z), row_z(box.max.z), [&](int z) {
      return any_from(row_y(box.min.y), row_y(middle.y), row_y(box.max.y), [&](int y) {
        const std::size_t row =
            static_cast<std::size_t>(z) * static_cast<std::size_t>(count_y_) + static_cast<std::size_t>(y);
        const Entry* const end = entries_.data() + rows_.end(row);
        for (const Entry* e = first_from(row, box.min.x); e != end && e->point.x <= box.max.x; ++e) {
          const Point& p = e->point;
          if (p.y < box.min.y || p.y > box.max.y || p.z < box.min.z || p.z > box.max.z) continue;
          if (visit(e->index, p)) return true;
        }
        return false;
      });
    });
  }

  /// Calls visit(index, point, squared distance) for the points nearer to p than radius_mm, as any_in() does.
  template <class Visit>
  bool any_near(const Point& p, double radius_mm, Visit visit) const {
    const Vec reach{radius_mm, radius_mm, radius_mm};
    return any_in({p - reach, p + reach}, [&](std::uint32_t index, const Point& q) {
      const double squared = squared_distance(p, q);
      return squared < radius_mm * radius_mm && visit(index, q, squared);
    });
  }

  /// All points, row by row: near in this order is near in space.
  const LargeVector<Entry>& entries() const { return entries_; }

 private:
  /// Calls visit(n) for the middle one of [first, last], then for those around it, until it returns true.
  template <class Visit>
  static bool any_from(int first, int middle, int last, Visit visit) {
    if (visit(middle)) return true;
    for (int off = 1; middle - off >= first || middle + off <= last; ++off) {
      if (middle - off >= first && visit(middle - off)) return true;
      if (middle + off <= last && visit(middle + off)) return true;
    }
    return false;
  }
  int row_y(double y) const { return row_of((y - min_.y) * inverse_, count_y_); }
  int row_z(double z) const { return row_of((z - min_.z) * inverse_, count_z_); }
  static int row_of(double position, int count) {
    return position > 0 ? static_cast<int>(std::min(position, count - 1.0)) : 0;
  }
  /// The first entry of the row whose x is not less.
  const Entry* first_from(std::size_t row, double x) const {
    const Entry* low = entries_.data() + rows_.begin(row);
    std::size_t length = rows_.end(row) - rows_.begin(row);
    while (length > 0) {
      const std::size_t half = length / 2;
      const bool before = low[half].point.x < x;
      low += before ? half + 1 : 0;
      length = before ? length - half - 1 : half;
    }
    return low;
  }

  Point min_;
  double inverse_ = 0;  // of the width of a row
  int count_y_ = 1;
  int count_z_ = 1;
  ParallelBuckets rows_;
  LargeVector<Entry> entries_;
};

}  // namespace scantet
