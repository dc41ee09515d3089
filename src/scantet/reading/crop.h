// A scan cut to a box.
#pragma once

#include <array>
#include <limits>
#include <string>

#include "scantet/base/api.h"
#include "scantet/field/scan.h"

namespace SCANTET_API scantet {

/// What a scan is cut to. A bound that is infinite is that of the image.
struct CropBox {
  /// What the bounds count in.
  enum class Unit {
    mm,     ///< along the axes of the world, LPS
    voxels  ///< along the axes of the image; 0 is the first voxel
  };
  /// No bound: infinity, with a minus sign where it is the lower one.
  static constexpr double kFree = std::numeric_limits<double>::infinity();

  Unit unit = Unit::mm;                               ///< of the bounds
  std::array<double, 3> low{-kFree, -kFree, -kFree};  ///< lower bound along each axis
  std::array<double, 3> high{kFree, kFree, kFree};    ///< upper bound along each axis
};

/// Reads "X0:X1,Y0:Y1,Z0:Z1", finite numbers in the unit; a bound may be left out, and is kFree then. place: opens
/// messages, "--crop". Throws Error: usage.crop (not of that form, or a range that runs backwards).
CropBox read_crop(const std::string& place, const std::string& text, CropBox::Unit unit);

/// The voxels whose centres are in the box, walls included (to a millionth of a voxel), in the same place of the world.
/// Of an image whose axes are not those of the world, a box in mm stands for the smallest box along the image's axes
/// around it. A box may reach beyond the image. Return: a copy of these voxels in their own type, with the scan's
/// format and segments; the scan itself, sharing its voxels, if all are in the box. Throws Error: usage.crop (a range
/// that runs backwards, or fewer than two voxels in the box along an axis), input.constant (they have one value).
Scan cropped(const Scan& scan, const CropBox& box);

}  // namespace scantet
