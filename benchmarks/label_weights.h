// The weights that CGAL's guide recommends for a segmentation.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace scantet::bench {

/// The largest of all labels' indicators (255 where the label is, else 0), each smoothed by a Gaussian, at each voxel.
/// CGAL 5.5's own generate_label_weights() smooths along the first axis only; this smooths along all three.
/// size, spacing: of the image, x fastest. sigma: of the Gaussian, in the unit of the spacing.
std::vector<std::uint8_t> label_weights(const std::vector<std::uint8_t>& labels, const std::array<int, 3>& size,
                                        const std::array<double, 3>& spacing, double sigma);

}  // namespace scantet::bench
