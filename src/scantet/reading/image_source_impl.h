// What the reader needs of a file format: a header first, then voxels into memory of the caller's. Internal to the
// reader.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scantet/base/error.h"
#include "scantet/base/geometry.h"
#include "scantet/base/progress.h"
#include "scantet/field/scan.h"

namespace scantet {

/// The ten pixel types, in the order of VoxelPointer's alternatives.
enum class VoxelType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// Bytes of one voxel.
int voxel_bytes(VoxelType type);

/// The type of numbers of so many bytes; none if it is none of the ten.
std::optional<VoxelType> voxel_type(std::size_t bytes, bool is_real, bool is_signed);

/// A segment that a header names. Segments that overlap are in different layers, each with labels of its own.
struct HeaderSegment {
  ScanSegment segment;
  std::int64_t layer = 0;
};

/// What a header says, before anything is judged.
struct ImageHeader {
  std::string format;                     ///< "NRRD", "NIfTI" …
  std::vector<std::int64_t> size;         ///< along each axis of the file, however many there are
  std::array<Vec, 3> columns;             ///< world step of each index axis, mm, LPS
  Point origin;                           ///< world position of voxel (0, 0, 0), mm, LPS
  std::optional<VoxelType> type;          ///< none: not one of the ten
  int components = 1;                     ///< values per voxel
  std::string pixel_kind = "scalar";      ///< "scalar", "rgb", "complex", "vector" …
  std::string type_name;                  ///< what the library calls the type, for messages
  std::string of_labels;                  ///< as Scan::header_of_labels
  std::vector<HeaderSegment> segments{};  ///< in the header's order
};

/// An opened image.
class ImageSource {
 public:
  virtual ~ImageSource() = default;
  virtual const ImageHeader& header() const = 0;
  /// Fills `voxels`, room for all of them in header().type: values of a voxel fastest, then x. False if cancelled.
  /// Throws Error (input.corrupt).
  virtual bool read(void* voxels, Progress& progress) = 0;
  /// As Scan::overlapping, of a source that merges segments itself; known once read() is through.
  virtual std::uint64_t overlapping() const { return 0; }
};

/// Opens an image, perhaps in a child process; null if cancelled.
using SourceOpener = std::function<std::unique_ptr<ImageSource>(Progress&)>;

/// Opens and reads an image in a child process with limits of time and memory, for formats that go through libraries:
/// what happens to them there becomes an Error (input.corrupt). Null if cancelled. Throws as `open`, and internal.fork.
std::unique_ptr<ImageSource> open_apart(const std::string& path, const SourceOpener& open, Progress& progress);

/// Opens a file through ITK. Throws Error: input.format, input.corrupt, input.too_large.
std::unique_ptr<ImageSource> open_itk_image(const std::string& path);

/// True if the file begins like one that open_itk_image takes. No library looks at it.
bool is_itk_image(const std::string& path);

/// Opens the one series of a DICOM folder, or the one whose identifier begins with `uid`; null if cancelled.
/// Throws Error: input.format, input.series, input.slices, input.corrupt.
std::unique_ptr<ImageSource> open_dicom_series(const std::string& folder, const std::string& uid, Progress& progress);

/// Opens a DICOM segmentation object (SEG). Segments of kind BINARY come as one label map of their numbers, in which a
/// voxel of several is in the last of them, as does a LABELMAP; those of kind FRACTIONAL as shares from 0 to 1, one
/// volume a segment. Slices that no frame has are empty. Throws Error: input.corrupt, input.slices, input.format
/// (compressed or deflated), input.labels (frames of segments that the header does not name).
std::unique_ptr<ImageSource> open_dicom_segmentation(const std::string& path);

/// True if the file is one.
bool is_dicom_segmentation(const std::string& path);

/// True if the file has DICOM's magic number.
bool is_dicom_file(const std::string& path);

/// Opens a TIFF file, all pages of one size. Throws Error: input.corrupt, input.slices, input.dimension.
std::unique_ptr<ImageSource> open_tiff_stack(const std::string& path);

/// True if the file has one of TIFF's magic numbers.
bool is_tiff_file(const std::string& path);

/// Opens a NIfTI-1, NIfTI-2 or Analyze 7.5 file, or either file of a .hdr/.img pair. Frame: the sform if sform_code >
/// 0, else the qform if qform_code > 0, else the spacing along LPS axes. Scaled integers become float (8 and 16 bits)
/// or double. Throws Error: input.corrupt. Source: nifti1.h, "3D IMAGE (VOLUME) ORIENTATION AND LOCATION IN SPACE",
/// methods 3, 2 and 1.
std::unique_ptr<ImageSource> open_nifti_image(const std::string& path);

/// True if the file, or the header beside it, is one that open_nifti_image takes.
bool is_nifti_file(const std::string& path);

/// Opens an INRIMAGE-4 file (.inr, .inr.gz). Throws Error: input.corrupt, input.frame (a rotation).
std::unique_ptr<ImageSource> open_inr_image(const std::string& path);

/// True if the file, unpacked if need be, begins like one.
bool is_inr_image(const std::string& path);

/// Why the first bytes of a gzip file cannot be decompressed; empty if they can, or if it is none.
std::string gzip_problem(const std::string& path);

/// The first `count` bytes of a file, fewer if it is shorter or cannot be read.
std::string first_bytes(const std::string& path, std::size_t count);

/// The error for a file that is truncated or damaged. reason: the library's own words; condensed to one line.
Error corrupt_file(const std::string& path, const std::string& reason);

}  // namespace scantet
