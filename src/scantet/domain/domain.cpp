// Default surface candidates: three families of parallel lines, so that a plugin with two queries is complete.
#include "scantet/domain/domain.h"

#include "scantet/base/parallel.h"
#include "scantet/domain/crossing_points.h"

namespace scantet {

void Domain::regions_at(std::span<const Point> points, std::span<Region> out) const {
  for (std::size_t i = 0; i < points.size(); ++i) out[i] = region_at(points[i]);
}

void Domain::crossings_of(std::span<const Segment> segments, CrossingLists& out) const {
  out.clear();
  Crossings one;
  for (const Segment& segment : segments) {
    crossings(segment, one);
    out.append(one);
  }
}

/// A line along some axis is not in the boundary; the shortest segments that meet it stay clear of other boundaries.
Patch Domain::patch_at(const Point& p) const {
  const double diagonal = bounds().diagonal();
  Crossings around;
  for (const double reach : {1e-12, 1e-10, 1e-8, 1e-6, 1e-4}) {
    for (int axis = 0; axis < 3; ++axis) {
      Segment segment{p, p};
      segment.source[axis] -= reach * diagonal;
      segment.target[axis] += reach * diagonal;
      crossings(segment, around);
      if (around.empty()) continue;
      const auto nearest = std::min_element(around.begin(), around.end(), [&](const Crossing& a, const Crossing& b) {
        return squared_distance(a.point, p) < squared_distance(b.point, p);
      });
      return nearest->patch();
    }
  }
  return {};
}

void Domain::surface_candidates(double spacing_mm, const PointSink& sink) const {
  const Box box = bounds();
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const auto lines_along = [&](int a) {
      return static_cast<std::size_t>(std::ceil(box.extent()[a] / spacing_mm)) + 1;
    };
    const auto at = [&](int a, std::size_t i) {
      return std::min(box.min[a] + static_cast<double>(i) * spacing_mm, box.max[a]);
    };
    constexpr std::size_t kRows = 64;  // worked on side by side, then handed on in order
    std::vector<std::vector<Point>> rows(kRows);
    for (std::size_t first = 0; first < lines_along(u); first += kRows) {
      const std::size_t count = std::min(kRows, lines_along(u) - first);
      parallel_for(count, 1, [&](std::size_t row, std::size_t) {
        CrossingPoints found(*this, rows[row]);
        for (std::size_t j = 0; j < lines_along(v); ++j) {
          Segment line{box.min, box.min};
          line.source[u] = line.target[u] = at(u, first + row);
          line.source[v] = line.target[v] = at(v, j);
          line.target[axis] = box.max[axis];
          found.add(line);
        }
        found.finish();
      });
      for (std::size_t row = 0; row < count; ++row) {
        for (const Point& p : rows[row]) sink(p);
        rows[row].clear();
      }
    }
  }
}

}  // namespace scantet
