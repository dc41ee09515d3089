// A grey image in memory, in its own pixel type, with no image library in sight.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/color.h"
#include "scantet/base/frame.h"

namespace SCANTET_API scantet {

/// Voxel values, x fastest, in the pixel type of the file.
using VoxelPointer = std::variant<const std::int8_t*, const std::uint8_t*, const std::int16_t*, const std::uint16_t*,
                                  const std::int32_t*, const std::uint32_t*, const std::int64_t*, const std::uint64_t*,
                                  const float*, const double*>;

/// What an image's header says of a label.
struct ScanSegment {
  std::int64_t label = 0;        ///< the value of its voxels
  std::string name{};            ///< may be empty
  std::optional<Color> color{};  ///< if the header has one
  std::uint64_t voxels = 0;      ///< that the file has in it, of segments that may overlap; else 0
  std::uint64_t covered = 0;     ///< those of them that a later segment has here
};

/// A three-dimensional image of finite scalar values. Copies share the voxels.
struct Scan {
  std::array<int, 3> size{};          ///< voxels along each axis, each ≥ 2
  Frame frame;                        ///< voxel index (of voxel centres) to world, mm, LPS
  VoxelPointer voxels;                ///< size[0]·size[1]·size[2] values
  std::shared_ptr<const void> owner;  ///< keeps the voxels alive; null: whoever made the Scan does
  double min_value = 0;               ///< smallest and largest value: computed by whoever makes the Scan
  double max_value = 0;
  std::string pixel_type;  ///< as people call it: "uint8", "int16", "float" …
  std::string format;      ///< "NRRD", "NIfTI" …
  /// What in the header says that the values are labels ("its NIfTI intent is 1002, NIFTI_INTENT_LABEL"); empty:
  /// nothing.
  std::string header_of_labels{};
  std::vector<ScanSegment> segments{};  ///< the labels that the header names, in its order; may lack any
  /// Voxels that the file has in several segments; here each is in the last of them.
  std::uint64_t overlapping = 0;

  /// How many voxels there are in all.
  std::int64_t voxel_count() const { return std::int64_t{size[0]} * size[1] * size[2]; }
};

}  // namespace scantet
