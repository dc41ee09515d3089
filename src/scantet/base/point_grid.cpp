// A counting sort into rows, then a sort of each row.
#include "scantet/base/parallel.h"
#include "scantet/base/point_grid_impl.h"

namespace scantet {

PointGrid::PointGrid(const std::vector<Point>& points, double row_mm) {
  if (points.empty()) return;
  const Box box = parallel_bounds(points.size(), [&](std::size_t i) { return points[i]; });
  min_ = box.min;
  // Not many more rows than points.
  const double smallest = std::sqrt(box.extent().y * box.extent().z / (2.0 * static_cast<double>(points.size())));
  inverse_ = 1 / std::max(row_mm, smallest);
  const auto rows_along = [&](int axis) {
    constexpr double kMost = 1 << 15;
    return 1 + static_cast<int>(std::min(box.extent()[axis] * inverse_, kMost));
  };
  count_y_ = rows_along(1);
  count_z_ = rows_along(2);
  const auto row_of_point = [&](const Point& p) {
    return static_cast<std::size_t>(row_z(p.z)) * static_cast<std::size_t>(count_y_) +
           static_cast<std::size_t>(row_y(p.y));
  };
  const std::size_t rows = static_cast<std::size_t>(count_y_) * static_cast<std::size_t>(count_z_);
  constexpr std::size_t kPoints = 4096;
  rows_ = ParallelBuckets(rows);
  parallel_for(points.size(), kPoints, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) rows_.count(row_of_point(points[i]));
  });
  entries_.resize(rows_.close());
  parallel_for(points.size(), kPoints, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      entries_[rows_.place(row_of_point(points[i]))] = {points[i], static_cast<std::uint32_t>(i)};
    }
  });
  constexpr std::size_t kRows = 256;
  parallel_for(rows, kRows, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      std::sort(entries_.data() + rows_.begin(r), entries_.data() + rows_.end(r), [](const Entry& a, const Entry& b) {
        return a.point == b.point ? a.index < b.index : lexicographically_less(a.point, b.point);
      });
    }
  });
}

}  // namespace scantet
