// What `scantet info` tells of a scan: values, histogram, orientation, and what touches the border at a level.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scantet/field/level_settings.h"
#include "scantet/field/scan.h"

namespace scantet {

/// Counts of voxel values; bin b holds the values v with floor((v - lower) / bin_width) == b (the largest value is in
/// the last bin).
struct ValueHistogram {
  double lower = 0;                   ///< where bin 0 begins, in voxel values
  double bin_width = 1;               ///< > 0
  std::vector<std::uint64_t> counts;  ///< never empty; sums to the number of voxels
  bool exact = false;                 ///< one integer value a bin, in its middle
};

/// The histogram of all voxels. Integer images whose values span at most 65,536 have one bin a value; all others 65,536
/// bins from the smallest to the largest value.
ValueHistogram histogram_of(const Scan& scan);

inline constexpr std::array<int, 7> kPercents{1, 5, 25, 50, 75, 95, 99};

/// Summary of the voxel values.
struct ScanStatistics {
  double min = 0;
  double max = 0;
  double mean = 0;                ///< of all voxels, to rounding
  double standard_deviation = 0;  ///< likewise
  /// The smallest value with at least kPercents[k] % of the voxels not above it: exact if histogram.exact, else the
  /// middle of its bin, so off by half a bin at most (1/131,072 of the value range).
  std::array<double, kPercents.size()> percentiles{};
  ValueHistogram histogram;
};

/// Two passes over the voxels.
ScanStatistics statistics_of(const Scan& scan);

/// How much of a face of the image is on the inside of a level.
struct FaceTouch {
  std::string face;     ///< index axis and side: "-i", "+i", "-j", "+j", "-k", "+k"
  char anatomical = 0;  ///< the side of the patient that the face looks to: L, R, P, A, S or I
  double share = 0;     ///< of the outermost voxels of the face, 0 … 1
};

/// Looks at the six outermost layers of voxels. Where a share is above 0 the surface is closed by the border of the
/// image, not by tissue.
std::array<FaceTouch, 6> border_touch(const Scan& scan, double level, InsideSide side);

/// How the index axes lie in the patient. The frame is LPS: world x grows to the left, y to posterior, z to superior.
struct Orientation {
  std::string code;          ///< where i, j and k grow to, "LPS" for an identity frame; each world axis once
  bool oblique = false;      ///< an axis is more than 1e-4 rad off the world axis that names it
  bool sheared = false;      ///< two axes are more than 1e-4 rad off a right angle
  bool left_handed = false;  ///< the frame mirrors
};

/// The assignment of world axes to index axes that fits best (largest sum of cosines).
Orientation orientation_of(const Frame& frame);

}  // namespace scantet
