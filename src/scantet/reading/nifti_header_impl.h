// Private: what the header of a NIfTI-1, NIfTI-2 or Analyze 7.5 file says, and how its files are opened.
#pragma once

#include <zlib.h>

#include <memory>
#include <string>

#include "scantet/reading/image_source_impl.h"

namespace scantet {

/// A file opened through zlib, which reads plain files as they are.
struct CloseGz {
  void operator()(gzFile_s* file) const { gzclose(file); }
};
using GzPointer = std::unique_ptr<gzFile_s, CloseGz>;

/// Of all three formats: the first bytes of every header.
inline constexpr int kNiftiHeaderBytes = 348;

/// What is needed to read the voxels.
struct NiftiHeader {
  ImageHeader image;                    ///< with the type that voxels have once they are scaled
  std::string voxel_file;               ///< where they are
  std::int64_t offset = 0;              ///< bytes in the voxel file before the first
  bool swapped = false;                 ///< the file has the other byte order
  VoxelType stored = VoxelType::uint8;  ///< the type in the file, if it is one of the ten
  bool scaled = false;                  ///< a value is slope · stored + intercept; if not, it is as stored
  double slope = 1;
  double intercept = 0;
};

/// Reads the header of either file of a .hdr/.img pair, or of a single file. Throws Error: input.corrupt.
NiftiHeader read_nifti_header(const std::string& path);

}  // namespace scantet
