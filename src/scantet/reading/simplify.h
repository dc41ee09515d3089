// Scans made simpler before they are meshed, as asked: noise taken out, or voxels made larger or smaller.
#pragma once

#include <cstdint>
#include <optional>

#include "scantet/field/scan.h"

namespace scantet {

/// What is done to a scan, in this order. Nothing by default.
struct Simplification {
  std::uint64_t median_voxels = 0;    ///< each value becomes the median within so many voxels along each axis; 0: not
  std::optional<double> smooth_mm;    ///< standard deviation of a Gaussian
  std::optional<double> resample_mm;  ///< distance of the new voxels along each axis, nearly: the outermost stay

  bool is_any() const { return median_voxels > 0 || smooth_mm || resample_mm; }
};

/// The scan after that; the scan itself if nothing is asked for. Beyond its border its outermost values go on. After a
/// median the values are of the scan's own type if that has at most 16 bits; else, and after a Gaussian, where it is
/// cut off at four standard deviations, or a new grid (trilinear between the old voxels), they are floats.
/// Throws Error (Fault::usage): usage.smooth (a deviation larger than the image), usage.median (more voxels than the
/// image has), usage.resample (more than 4·10⁹ voxels, or fewer than two along an axis); input.constant (nothing is
/// left but one value). Several threads.
Scan simplified(const Scan& scan, const Simplification& how);

}  // namespace scantet
