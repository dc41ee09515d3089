// What the labels of a segmentation mean.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/color.h"
#include "scantet/base/stratum.h"

namespace SCANTET_API scantet {

/// How the fields of labels are made.
enum class LabelSmoothing {
  none,      ///< 1 at the voxel centres of a label, 0 at others: interfaces show stairs
  keep,      ///< as smooth as may be while each voxel centre keeps its label
  gaussian,  ///< each label's share under a Gaussian: thin parts, small ones and narrow gaps can vanish
};

/// Which labels become which regions.
struct LabelSettings {
  /// Becomes kOutside, unless region_of names it; what lies beyond the image is kOutside, too.
  std::int64_t background = 0;
  /// What these labels become: a region, > 0, which several may share, or kOutside, the background. A region below 0 is
  /// refused. Labels that the image has not make no difference.
  std::map<std::int64_t, Region> region_of{};
  /// Labels that region_of does not name become regions of their own number; otherwise they belong to the background.
  bool keep_others = true;
  /// What people call the regions; may lack any.
  std::map<Region, std::string> names{};
  /// The colours of regions, for reports; may lack any.
  std::map<Region, Color> colors{};
  LabelSmoothing smoothing = LabelSmoothing::none;  ///< the command's default is keep
  /// Of LabelSmoothing::gaussian: its standard deviation, > 0, and less than the longest edge of the image.
  double gaussian_mm = 0;
};

/// What each of an image's labels becomes, in their order. labels: ascending, from 0 to 2^31 - 1. A background that is
/// not 0 leaves 0 without a number of its own, if it is kept: it gets the one after the largest. Throws Error:
/// input.labels (there is none after that), usage.labels (region_of has a region below 0).
std::vector<Region> regions_of_labels(const std::vector<std::int64_t>& labels, const LabelSettings& settings);

}  // namespace scantet
