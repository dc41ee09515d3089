// A scan from an image of VTK's, whose voxels stay where they are. Needs VTK's headers (CommonDataModel), and is in no
// other header of scantet's: include it where you have VTK.
#pragma once

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>

#include "scantet/base/error.h"
#include "scantet/base/frame.h"
#include "scantet/field/scan_from_memory.h"

namespace scantet {

/// How the world axes of a vtkImageData lie, of which VTK itself says nothing.
enum class VtkAxes {
  lps,  ///< as ITK and DICOM have them
  ras   ///< as NIfTI and 3D Slicer have them: x and y are negated
};

/// The values in the type of VoxelPointer that has their size and sign, by their type in VTK. values: lie one behind
/// the other in memory; the pointer does not keep them. Throws Error: input.pixel_type (bits, texts and other values
/// that are no numbers of 8 to 64 bits).
inline VoxelPointer voxel_pointer_to(vtkDataArray& values) {
  const void* const plain = values.GetVoidPointer(0);
  const int type = values.GetDataType();
  if (type == VTK_FLOAT) return static_cast<const float*>(plain);
  if (type == VTK_DOUBLE) return static_cast<const double*>(plain);
  const bool is_whole = type != VTK_BIT && type != VTK_VOID && values.GetDataTypeSize() > 0;
  const bool is_signed = values.GetDataTypeMin() < 0;
  switch (is_whole ? values.GetDataTypeSize() : 0) {
    case 1:
      if (is_signed) return static_cast<const std::int8_t*>(plain);
      return static_cast<const std::uint8_t*>(plain);
    case 2:
      if (is_signed) return static_cast<const std::int16_t*>(plain);
      return static_cast<const std::uint16_t*>(plain);
    case 4:
      if (is_signed) return static_cast<const std::int32_t*>(plain);
      return static_cast<const std::uint32_t*>(plain);
    case 8:
      if (is_signed) return static_cast<const std::int64_t*>(plain);
      return static_cast<const std::uint64_t*>(plain);
    default:
      throw Error(Fault::input, "input.pixel_type",
                  std::string("the VTK image has voxels of type '") + values.GetDataTypeAsString() + "'",
                  "convert them to an 8- to 64-bit integer, float or double");
  }
}

/// From the index of a voxel, (0, 0, 0) being the first one of the image's extent, to the world, mm, LPS: by the
/// image's extent, origin, spacing and direction matrix. axes: those of the image. Throws Error (input.frame) as
/// Frame() does.
inline Frame frame_from_vtk(vtkImageData& image, VtkAxes axes) {
  const double across = axes == VtkAxes::ras ? -1 : 1;
  const auto turned = [&](double x, double y, double z) { return Vec{across * x, across * y, z}; };
  const vtkMatrix3x3& direction = *image.GetDirectionMatrix();
  std::array<Vec, 3> columns;
  Point origin = turned(image.GetOrigin()[0], image.GetOrigin()[1], image.GetOrigin()[2]);
  for (int axis = 0; axis < 3; ++axis) {
    columns[axis] = image.GetSpacing()[axis] *
                    turned(direction.GetElement(0, axis), direction.GetElement(1, axis), direction.GetElement(2, axis));
    origin = origin + image.GetExtent()[2 * axis] * columns[axis];
  }
  return {columns, origin};
}

/// The active scalars of the points of an image, looked at once for their range and not copied. The scan holds a
/// reference to their array, so the image itself may go; its values must not change as long as the scan, a copy of it,
/// or a domain made from one of these lives.
///
/// axes: those of the image. Return: a scan called "VTK image" in messages, with the frame of frame_from_vtk().
/// Throws Error (Fault::input): input.format (null), input.pixel_type (no scalars, several values a voxel, a type that
/// is none of the ten, an array that is not laid out value by value), input.dimension (not one value a voxel, or fewer
/// than two voxels along an axis), input.frame (as Frame()), input.nan, input.constant, input.range (values beyond
/// 1e100).
inline Scan scan_from_vtk(vtkImageData* image, VtkAxes axes = VtkAxes::lps) {
  if (image == nullptr) throw Error(Fault::input, "input.format", "there is no VTK image", "give one that was made");
  const vtkSmartPointer<vtkDataArray> values = image->GetPointData()->GetScalars();
  if (values == nullptr) {
    throw Error(Fault::input, "input.pixel_type", "the VTK image has no active scalars", "name them: SetActiveScalars");
  }
  if (values->GetNumberOfComponents() != 1 || !values->HasStandardMemoryLayout()) {
    throw Error(Fault::input, "input.pixel_type",
                "the VTK image has " + std::to_string(values->GetNumberOfComponents()) +
                    " values per voxel or a layout of its own; scantet takes one, in a plain array",
                "extract one component (vtkImageExtractComponents)");
  }
  std::array<int, 3> size{};
  image->GetDimensions(size.data());
  check_voxel_count(static_cast<std::size_t>(values->GetNumberOfTuples()), size);
  const auto owner = std::make_shared<const vtkSmartPointer<vtkDataArray>>(values);
  return make_scan(voxel_pointer_to(*values), size, frame_from_vtk(*image, axes), owner, "VTK image");
}

}  // namespace scantet
