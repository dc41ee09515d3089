// Sizes from an image.
#pragma once

#include <vector>

#include "scantet/field/scan.h"
#include "scantet/sizing/size_source.h"

namespace scantet {

/// Trilinear between the voxel centres of an image of sizes in mm, in the image's own frame; beyond its border, the
/// size is that at the nearest point of it. If one of the voxels that a size depends on is not greater than 0, the size
/// is that voxel's value, which is refused by whoever asked.
class SizeImage final : public SizeSource {
 public:
  explicit SizeImage(const Scan& scan);
  void sizes_at(std::span<const SizePlace> places, std::span<double> sizes) const override;
  double finest_mm() const override { return frame_.min_spacing_mm(); }

 private:
  double at(const Point& p) const;

  std::array<int, 3> size_;
  Frame frame_;
  std::vector<float> voxels_;
};

}  // namespace scantet
