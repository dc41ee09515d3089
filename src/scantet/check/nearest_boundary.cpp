// The boxes that may hold the surface wait in a heap, the nearest first. It gives a point of the surface, or is
// divided; what is nearest in the heap bounds the answer from below.
#include <algorithm>
#include <limits>
#include <vector>

#include "scantet/check/boundary_box_impl.h"
#include "scantet/check/nearest_boundary_impl.h"

namespace scantet {
namespace {

constexpr double kLeastBox = 1.0 / 256;  // of a cell
constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct Waiting {
  double least_mm;
  BoundaryBox box;
};

bool waits_longer(const Waiting& a, const Waiting& b) {
  return a.least_mm > b.least_mm;
}

NearestBoundary search(const BoundaryCells& cells, std::size_t surface, const std::vector<BoundaryCell>& list,
                       const Point& p, double enough_mm, double tolerance) {
  std::vector<Waiting> heap;
  for (const BoundaryCell& cell : list) {
    const BoundaryBox box(cell);
    if (box.may_hold(cells, surface)) heap.push_back({box.least_distance_mm(p), box});
  }
  std::make_heap(heap.begin(), heap.end(), waits_longer);
  NearestBoundary found{0, kInfinite, {}};
  while (!heap.empty()) {
    std::pop_heap(heap.begin(), heap.end(), waits_longer);
    const Waiting nearest = heap.back();
    heap.pop_back();
    found.lower_mm = std::min(nearest.least_mm, found.upper_mm);
    if (found.upper_mm <= enough_mm || found.upper_mm <= (1 + tolerance) * found.lower_mm) return found;
    if (const std::optional<Point> point = nearest.box.witness(cells, surface)) {
      const double distance_mm = distance(p, *point);
      if (distance_mm < found.upper_mm) found.upper_mm = distance_mm, found.point = *point;
    }
    if (nearest.box.size() <= kLeastBox) return found;
    for (int corner = 0; corner < 8; ++corner) {
      const BoundaryBox part = nearest.box.part(corner);
      if (!part.may_hold(cells, surface)) continue;
      const double least_mm = part.least_distance_mm(p);
      if (least_mm >= found.upper_mm) continue;
      heap.push_back({least_mm, part});
      std::push_heap(heap.begin(), heap.end(), waits_longer);
    }
  }
  found.lower_mm = found.upper_mm;
  return found;
}

}  // namespace

NearestBoundary nearest_boundary(const BoundaryCells& cells, std::size_t surface, const Point& p, double around_mm,
                                 double most_mm, double enough_mm, double tolerance) {
  std::vector<BoundaryCell> list;
  for (double reach_mm = around_mm;; reach_mm *= 2) {
    const Vec reach{reach_mm, reach_mm, reach_mm};
    list.clear();
    cells.cells_in(surface, {p - reach, p + reach}, list);
    NearestBoundary found = search(cells, surface, list, p, enough_mm, tolerance);
    if (found.upper_mm <= reach_mm) return found;
    if (reach_mm >= most_mm) {
      found.lower_mm = std::min(found.lower_mm, reach_mm);
      return found;
    }
  }
}

}  // namespace scantet
