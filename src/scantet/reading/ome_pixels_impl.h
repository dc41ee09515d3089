// What the description of an OME-TIFF says of its pages. Private to reading/.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace scantet {

/// The image of an OME-TIFF: its element Pixels.
struct OmePixels {
  std::int32_t channels;  ///< these three from 1 on
  std::int32_t times;
  std::int32_t slices;
  std::array<std::optional<double>, 3> step_mm;  ///< > 0; none along axes that have no length
};

/// The image that a description is of; nullopt if it is not that of an OME-TIFF. path: for messages. Throws Error:
/// input.dimension (of several images, or none), input.slices (a size that is no whole number from 1 on), input.frame
/// (a step that is no length).
std::optional<OmePixels> ome_pixels(const std::string& description, const std::string& path);

}  // namespace scantet
