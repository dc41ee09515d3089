// The skeleton of a DICOM file, walked before GDCM sees it. Internal to the reader.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scantet/base/geometry.h"

namespace scantet {

/// A segment that a segmentation names.
struct DicomSegment {
  int number = 0;
  std::string label;
  std::vector<std::uint16_t> cielab;  ///< Recommended Display CIELab Value: three numbers, or none
};

/// What a segmentation object says of its frames.
struct SegmentationOutline {
  std::string kind;  ///< Segmentation Type: "BINARY", "FRACTIONAL" or "LABELMAP"
  std::vector<DicomSegment> segments;
  std::vector<int> frame_segments;       ///< Referenced Segment Number of each frame; none in a LABELMAP
  std::vector<double> orientation;       ///< Image Orientation (Patient): six numbers, the first that the file has
  std::vector<double> pixel_spacing_mm;  ///< between rows, between columns
  std::optional<double> slice_step_mm;   ///< Spacing Between Slices
  std::optional<double> thickness_mm;    ///< Slice Thickness
  int most = 0;                          ///< Maximum Fractional Value
  std::int64_t rows = 0;
  std::int64_t columns = 0;
  std::int64_t frames = 0;
  std::int64_t bits = 0;                    ///< of a pixel
  std::int64_t pixels_at = 0;               ///< where they begin in the file, if they are not compressed
  std::optional<std::int64_t> pixel_bytes;  ///< none: they are compressed
};

/// What the walk over a file's elements found.
struct DicomOutline {
  std::string problem;                 ///< why the file is no sound DICOM file; empty if it is
  bool has_pixels = false;             ///< there is a Pixel Data element: an image
  std::vector<Point> frame_positions;  ///< Image Position (Patient) of each frame of an enhanced multi-frame file, mm
  std::optional<SegmentationOutline> segmentation;  ///< of a segmentation object (SEG), that is not deflated
};

/// Walks the elements of a file and of its sequences, without reading values other than sizes and positions: each must
/// end within the file, and uncompressed pixel data must be as long as rows, columns and frames ask. GDCM as Debian
/// builds it has its assertions on: a file cut off within an element would end the process. Deflated files are not
/// walked: no problem, pixels assumed. Source: DICOM PS3.5, section 7 (data set), annex A (transfer syntaxes).
DicomOutline outline_of(const std::string& path);

}  // namespace scantet
