#include "scantet/places/scan_values.h"

#include <algorithm>

#include "scantet/base/trilinear.h"

namespace scantet {

double ScanValues::at(const Point& p) const {
  const Vec index = scan_.frame.to_index(p);
  std::array<std::int64_t, 3> low{};
  Vec part;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double within = std::clamp(index[axis], 0.0, scan_.size[a] - 1.0);
    low[a] = std::min(static_cast<std::int64_t>(within), static_cast<std::int64_t>(scan_.size[a]) - 2);
    part[axis] = within - static_cast<double>(low[a]);
  }
  const std::int64_t row = scan_.size[0];
  const std::int64_t slice = row * scan_.size[1];
  const std::int64_t first = low[0] + row * low[1] + slice * low[2];
  return std::visit(
      [&](const auto* voxels) {
        CellHeights values;
        for (std::size_t corner = 0; corner < 8; ++corner) {
          const std::int64_t x = corner & 1;
          const std::int64_t y = corner >> 1 & 1;
          const std::int64_t z = corner >> 2;
          values[corner] = static_cast<double>(voxels[first + x + row * y + slice * z]);
        }
        return trilinear(values, part);
      },
      scan_.voxels);
}

}  // namespace scantet
