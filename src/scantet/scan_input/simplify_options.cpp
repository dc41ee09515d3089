#include "scantet/scan_input/simplify_options.h"

#include <algorithm>
#include <cmath>

#include "scantet/base/error.h"
#include "scantet/base/frame.h"

namespace scantet {
namespace {

std::string range_text(double low, double high) {
  const auto bound = [](double value) {
    return value == CropBox::kFree || value == -CropBox::kFree ? "" : number_text(value);
  };
  return bound(low) + ":" + bound(high);
}

/// Whether each axis of the image is one of the world.
bool is_along_axes(const Frame& frame) {
  constexpr double kRounding = 1e-6;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec& column = frame.column(axis);
    const double most = std::max({std::abs(column.x), std::abs(column.y), std::abs(column.z)});
    if (length(column) > (1 + kRounding) * most) return false;
  }
  return true;
}

/// What is done, step by step: its key, its name and how it was asked for.
std::vector<std::array<std::string, 3>> steps_of(const Simplification& how) {
  std::vector<std::array<std::string, 3>> steps;
  if (how.crop) {
    std::string box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box += (axis == 0 ? "" : ",") + range_text(how.crop->low[axis], how.crop->high[axis]);
    }
    steps.push_back({"crop", "a cut", (how.crop->unit == CropBox::Unit::mm ? "--crop " : "--crop-voxels ") + box});
  }
  if (how.median_voxels > 0) steps.push_back({"median", "a median", "--median " + std::to_string(how.median_voxels)});
  if (how.smooth_mm) {
    const bool gaussian = how.smoothing == Smoothing::gaussian;
    steps.push_back({"smooth", gaussian ? "a Gaussian" : "curvature flow", "--smooth " + number_text(*how.smooth_mm)});
  }
  if (how.resample_mm) steps.push_back({"resample", "a new grid", "--resample " + number_text(*how.resample_mm)});
  return steps;
}

}  // namespace

void SimplifyOptions::declare(OptionSet& options, const std::string& group) {
  constexpr double kMostVoxels = 16;  // a median within more takes minutes
  const std::string box = "X0:X1,Y0:Y1,Z0:Z1";
  options.add(
      "crop", crop_mm,
      {group, box, "a box in mm",
       "Before all else, the image is cut to the voxels whose centres are in this box, in mm of the world, LPS, "
       "as meshes are written without --space. A bound that is left out is that of the image: \":,:,20:\". What "
       "reaches the walls of the box ends there as at the border of an image. Of an image whose axes are not those of "
       "the world, the smallest block of voxels around the box is kept, which a note tells: --cut cuts straight.",
       0, "all of the image"});
  options.add("crop-voxels", crop_voxels,
              {group, box, "a box in voxels",
               "The same with a box along the axes of the image, in voxels counted from 0.", 0, "all of the image"});
  options.add(
      "median", how.median_voxels, Range::between(0, kMostVoxels),
      {group, "VOXELS", "a number of voxels",
       "Then each voxel gets the median of those at most so far away along each axis: 1 takes out single voxels "
       "of noise and keeps edges.",
       0, "0: no median"});
  options.add("smooth", how.smooth_mm, Range::above(0),
              {group, "MM", "a length in mm",
               "Then the image is smoothed with a Gaussian of this standard deviation. One voxel takes out most noise, "
               "and with it the smallest components, cavities and handles.",
               0, "no smoothing"});
  options.add(
      "smoothing", how.smoothing, {{"gaussian", Smoothing::gaussian}, {"curvature", Smoothing::curvature}},
      {group, "HOW", "a way of smoothing",
       "How --smooth smooths. gaussian: by a mean around each voxel, which also makes edges soft and moves the "
       "surface of thin parts; curvature: surfaces of equal value move by their curvature for as long as the "
       "Gaussian would take (ITK's curvature flow), so that edges stay sharp and each surface becomes smooth in "
       "itself."});
  options.add(
      "resample", how.resample_mm, Range::above(0),
      {group, "MM", "a length in mm",
       "Then the image gets voxels that are about so far apart along each axis, with values interpolated between "
       "the old ones. Larger voxels skip what lies between them: smooth first.",
       0, "the voxels of the image"});
}

Simplification SimplifyOptions::simplification() const {
  Simplification result = how;
  if (!crop_mm.empty() && !crop_voxels.empty()) {
    throw Error(Fault::usage, "usage.crop", "--crop-voxels: --crop says already what the image is cut to",
                "give one of the two");
  }
  if (!crop_mm.empty()) result.crop = read_crop("--crop", crop_mm, CropBox::Unit::mm);
  if (!crop_voxels.empty()) result.crop = read_crop("--crop-voxels", crop_voxels, CropBox::Unit::voxels);
  if (how.smoothing != Smoothing::gaussian && !how.smooth_mm) {
    throw Error(Fault::usage, "usage.no_effect", "--smoothing: it does nothing here: nothing is smoothed",
                "leave it out, or say by how much: --smooth");
  }
  return result;
}

std::string simplification_note(const Simplification& how, const Frame& frame) {
  std::string steps;
  for (const auto& [key, name, asked] : steps_of(how)) {
    steps += (steps.empty() ? "" : ", ") + name + " (" + asked + ")";
  }
  if (steps.empty()) return "";
  const bool is_block = how.crop && how.crop->unit == CropBox::Unit::mm && !is_along_axes(frame);
  return "the image is the one after " + steps + ", also in the audit: not as it was read" +
         (is_block ? "; its axes are not those of the world, so that --crop keeps the block of voxels around the box"
                   : "");
}

InfoSection describe_simplification(const Simplification& how) {
  InfoSection section{"simplified", "Made simpler before all that follows", {}};
  for (const auto& [key, name, asked] : steps_of(how)) section.entries.push_back({key, name, asked, ""});
  return section;
}

}  // namespace scantet
