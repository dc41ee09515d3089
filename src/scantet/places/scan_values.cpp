#include "scantet/places/scan_values.h"

#include <algorithm>
#include <cmath>

namespace scantet {

double ScanValues::at(const Point& p) const {
  const Vec index = scan_.frame.to_index(p);
  std::array<std::int64_t, 3> low{};
  std::array<double, 3> part{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double within = std::clamp(index[axis], 0.0, scan_.size[a] - 1.0);
    low[a] = std::min(static_cast<std::int64_t>(within), static_cast<std::int64_t>(scan_.size[a]) - 2);
    part[a] = within - static_cast<double>(low[a]);
  }
  const std::int64_t row = scan_.size[0];
  const std::int64_t slice = row * scan_.size[1];
  const std::int64_t first = low[0] + row * low[1] + slice * low[2];
  return std::visit(
      [&](const auto* voxels) {
        double sum = 0;
        for (int corner = 0; corner < 8; ++corner) {
          double weight = 1;
          std::int64_t at = first;
          const std::array<std::int64_t, 3> steps{1, row, slice};
          for (std::size_t a = 0; a < 3; ++a) {
            const bool is_far = (corner >> a & 1) != 0;
            weight *= is_far ? part[a] : 1 - part[a];
            if (is_far) at += steps[a];
          }
          sum += weight * static_cast<double>(voxels[at]);
        }
        return sum;
      },
      scan_.voxels);
}

}  // namespace scantet
