// A scan from an image of ITK's, whose voxels stay where they are. Needs ITK's headers, and is in no other header of
// scantet's: include it where you have ITK.
#pragma once

#include <itkImage.h>

#include <array>
#include <concepts>
#include <memory>
#include <type_traits>
#include <utility>

#include "scantet/base/error.h"
#include "scantet/base/frame.h"
#include "scantet/field/scan_from_memory.h"

namespace scantet {

/// A number of 8 to 64 bits as VoxelPointer has it: long long, say, as std::int64_t.
template <class Pixel>
concept ItkPixel =
    (std::integral<Pixel> && !std::same_as<Pixel, bool>) || std::same_as<Pixel, float> || std::same_as<Pixel, double>;

/// The same pointer in the type of VoxelPointer that has the pixel's size and sign. values: may be null.
template <ItkPixel Pixel>
VoxelPointer voxel_pointer_to(const Pixel* values) {
  if constexpr (std::floating_point<Pixel>) {
    return values;
  } else {
    constexpr bool kSigned = std::is_signed_v<Pixel>;
    using Byte = std::conditional_t<kSigned, std::int8_t, std::uint8_t>;
    using Two = std::conditional_t<kSigned, std::int16_t, std::uint16_t>;
    using Four = std::conditional_t<kSigned, std::int32_t, std::uint32_t>;
    using Eight = std::conditional_t<kSigned, std::int64_t, std::uint64_t>;
    const void* const plain = values;
    if constexpr (sizeof(Pixel) == 1) {
      return static_cast<const Byte*>(plain);
    } else if constexpr (sizeof(Pixel) == 2) {
      return static_cast<const Two*>(plain);
    } else if constexpr (sizeof(Pixel) == 4) {
      return static_cast<const Four*>(plain);
    } else {
      return static_cast<const Eight*>(plain);
    }
  }
}

/// The voxels of an image, looked at once for their range and not copied. The scan holds a reference to their
/// container, so the image itself may go; its values must not change as long as the scan, a copy of it, or a domain
/// made from one of these lives.
///
/// image: updated and buffered as a whole. Images of pixels that are no numbers (RGB, vectors) are refused by the
/// compiler. Return: a scan called "ITK image" in messages; its frame is LPS, mm, as in ITK, from origin, spacing,
/// direction and the index at which the region begins.
/// Throws Error (Fault::input): input.format (null), input.dimension (only a part of the image is in memory, or fewer
/// than two voxels along an axis), input.pixel_type (no voxels are allocated), input.frame (as Frame()), input.nan,
/// input.constant, input.range (values beyond 1e100).
template <ItkPixel Pixel>
Scan scan_from_itk(const itk::Image<Pixel, 3>* image) {
  if (image == nullptr) throw Error(Fault::input, "input.format", "there is no ITK image", "give one that was made");
  const auto region = image->GetBufferedRegion();
  if (region != image->GetLargestPossibleRegion()) {
    throw Error(Fault::input, "input.dimension", "only a part of the ITK image is in memory",
                "call UpdateLargestPossibleRegion() of the filter that makes it");
  }
  const auto direction = image->GetDirection();
  const auto spacing = image->GetSpacing();
  std::array<Vec, 3> columns;
  std::array<int, 3> size{};
  Point origin{image->GetOrigin()[0], image->GetOrigin()[1], image->GetOrigin()[2]};
  for (unsigned axis = 0; axis < 3; ++axis) {
    columns[axis] = spacing[axis] * Vec{direction[0][axis], direction[1][axis], direction[2][axis]};
    origin = origin + static_cast<double>(region.GetIndex()[axis]) * columns[axis];
    size[axis] = static_cast<int>(region.GetSize()[axis]);
  }
  using Container = typename itk::Image<Pixel, 3>::PixelContainer;
  const auto owner = std::make_shared<const typename Container::ConstPointer>(image->GetPixelContainer());
  return make_scan(voxel_pointer_to(image->GetBufferPointer()), size, Frame(columns, origin), owner, "ITK image");
}

}  // namespace scantet
