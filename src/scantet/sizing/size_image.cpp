// The voxels are copied as floats: sizes need no more digits.
#include "scantet/sizing/size_image.h"

namespace scantet {

SizeImage::SizeImage(const Scan& scan) : size_(scan.size), frame_(scan.frame) {
  voxels_.reserve(static_cast<std::size_t>(scan.voxel_count()));
  std::visit(
      [&](const auto* values) {
        for (std::int64_t i = 0; i < scan.voxel_count(); ++i) voxels_.push_back(static_cast<float>(values[i]));
      },
      scan.voxels);
}

double SizeImage::at(const Point& p) const {
  const Vec index = frame_.to_index(p);
  std::array<std::size_t, 3> low;
  std::array<double, 3> part;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double within = std::clamp(index[axis], 0.0, size_[a] - 1.0);
    low[a] = std::min(static_cast<std::size_t>(within), static_cast<std::size_t>(size_[a] - 2));
    part[a] = within - static_cast<double>(low[a]);
  }
  double sum = 0;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::size_t offset = 0;
    for (std::size_t a = 3; a-- > 0;) {
      const std::size_t step = corner >> a & 1;
      weight *= step == 1 ? part[a] : 1 - part[a];
      offset = offset * static_cast<std::size_t>(size_[a]) + low[a] + step;
    }
    const double value = static_cast<double>(voxels_[offset]);
    if (weight > 0 && !(value > 0)) return value;
    sum += weight * value;
  }
  return sum;
}

void SizeImage::sizes_at(std::span<const SizePlace> places, std::span<double> sizes) const {
  for (std::size_t i = 0; i < places.size(); ++i) sizes[i] = at(places[i].point);
}

}  // namespace scantet
