// Scans made simpler before they are meshed, as asked: noise taken out, or voxels made larger or smaller.
#pragma once

#include <cstdint>
#include <optional>

#include "scantet/base/api.h"
#include "scantet/field/scan.h"
#include "scantet/reading/crop.h"

namespace SCANTET_API scantet {

/// How a scan is smoothed.
enum class Smoothing {
  gaussian,  ///< each value becomes the mean around it, by the weights of a Gaussian: edges become soft
  /// Surfaces of equal value move by their curvature for as long as a Gaussian takes to spread so far: each becomes
  /// smooth in itself, and edges stay sharp. A ball of less than 1.4 standard deviations as radius vanishes.
  curvature
};

/// What is done to a scan, in this order. Nothing by default.
struct Simplification {
  std::optional<CropBox> crop;                ///< what is kept of it
  std::uint64_t median_voxels = 0;            ///< the median within so many voxels along each axis; 0: not
  std::optional<double> smooth_mm;            ///< standard deviation of a Gaussian, > 0
  Smoothing smoothing = Smoothing::gaussian;  ///< how, if smooth_mm is given
  std::optional<double> resample_mm;  ///< > 0: distance of the new voxels along each axis, nearly; the outermost stay

  /// Whether anything is asked for.
  bool is_any() const { return crop || changes_values(); }
  /// Whether values change, and not only their number.
  bool changes_values() const { return median_voxels > 0 || smooth_mm || resample_mm; }
};

/// The scan after that; the scan itself, sharing its voxels, if nothing is asked for. Beyond the border of what is kept
/// its outermost values go on for filters; a level set ends there as at the border of an image. After a median the
/// values are of the scan's own type if that is an integer of at most 16 bits; else, and after smoothing, where a
/// Gaussian is cut off at four standard deviations, or a new grid (trilinear between the old voxels), they are floats.
/// Where values change, segments and what the header says of labels are left out. Throws Error: usage.crop (as
/// cropped()); usage.median (as many voxels as the image has along its longest axis, or more); usage.smooth (a
/// deviation as large as the image's longest side, or so many voxels wide that curvature flow takes more than 2,000
/// steps); usage.resample (more than 4·10⁹ voxels, or fewer than two along an axis); input.constant (nothing is left
/// but one value); input.nan (values that floats do not hold). Several threads.
Scan simplified(const Scan& scan, const Simplification& how);

}  // namespace scantet
