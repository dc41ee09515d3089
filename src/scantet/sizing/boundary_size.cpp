// Exact, with no grid: a tree of cones finds the lowest one.
#include "scantet/sizing/boundary_size.h"

#include <algorithm>
#include <limits>

namespace scantet {

BoundarySize::BoundarySize(std::vector<Cone> sizes, double spacing_mm, bool bounds_tets) : bounds_tets_(bounds_tets) {
  const auto smaller = [](const Cone& a, const Cone& b) { return a.height_mm < b.height_mm; };
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end(), smaller);
  usual_mm_ = middle->height_mm;
  least_mm_ = std::min_element(sizes.begin(), sizes.end(), smaller)->height_mm;
  tree_ = ConeTree(std::move(sizes), spacing_mm);
}

double BoundarySize::size_at(const Point& p) const {
  return size_up_to(p, std::numeric_limits<double>::infinity());
}

double BoundarySize::size_up_to(const Point& p, double most_mm) const {
  return tree_.lowest_at(p, most_mm).value_mm;
}

}  // namespace scantet
