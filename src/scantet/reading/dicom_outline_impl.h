// The skeleton of a DICOM file, walked before GDCM sees it. Internal to the reader.
#pragma once

#include <string>
#include <vector>

#include "scantet/base/geometry.h"

namespace scantet {

/// What the walk over a file's elements found.
struct DicomOutline {
  std::string problem;                 ///< why the file is no sound DICOM file; empty if it is
  bool has_pixels = false;             ///< there is a Pixel Data element: an image
  std::vector<Point> frame_positions;  ///< Image Position (Patient) of each frame of an enhanced multi-frame file, mm
};

/// Walks the elements of a file and of its sequences, without reading values other than sizes and positions: each must
/// end within the file, and uncompressed pixel data must be as long as rows, columns and frames ask. GDCM as Debian
/// builds it has its assertions on: a file cut off within an element would end the process. Deflated files are not
/// walked: no problem, pixels assumed. Source: DICOM PS3.5, section 7 (data set), annex A (transfer syntaxes).
DicomOutline outline_of(const std::string& path);

}  // namespace scantet
