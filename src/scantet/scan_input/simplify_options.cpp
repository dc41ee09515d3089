#include "scantet/scan_input/simplify_options.h"

namespace scantet {

void SimplifyOptions::declare(OptionSet& options, const std::string& group) {
  constexpr double kMostVoxels = 16;  // a median within more takes minutes
  options.add("median", how.median_voxels, Range::between(0, kMostVoxels),
              {group, "VOXELS", "a number of voxels",
               "Before all else, each voxel gets the median of those at most so far away along each axis: 1 takes out "
               "single voxels of noise and keeps edges.",
               0, "0: no median"});
  options.add("smooth", how.smooth_mm, Range::above(0),
              {group, "MM", "a length in mm",
               "Then the image is smoothed with a Gaussian of this standard deviation. One voxel takes out most noise, "
               "and with it the smallest components, cavities and handles.",
               0, "no smoothing"});
  options.add(
      "resample", how.resample_mm, Range::above(0),
      {group, "MM", "a length in mm",
       "Then the image gets voxels that are about so far apart along each axis, with values interpolated between "
       "the old ones. Larger voxels skip what lies between them: smooth first.",
       0, "the voxels of the image"});
}

std::string SimplifyOptions::note() const {
  std::string steps;
  const auto add = [&](const std::string& step) { steps += (steps.empty() ? "" : ", ") + step; };
  if (how.median_voxels > 0) add("a median (--median " + std::to_string(how.median_voxels) + ")");
  if (how.smooth_mm) add("a Gaussian (--smooth " + number_text(*how.smooth_mm) + ")");
  if (how.resample_mm) add("a new grid (--resample " + number_text(*how.resample_mm) + ")");
  return steps.empty() ? "" : "the image is the one after " + steps + ", also in the audit: not as it was read";
}

}  // namespace scantet
