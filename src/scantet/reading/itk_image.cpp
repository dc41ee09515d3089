// One file through one of ITK's ImageIO classes, asked directly: ImageFileReader would add a template instantiation a
// pixel type and a conversion of the frame, and the factories would read ITK_AUTOLOAD_PATH. The order below is fixed,
// so the format chosen depends on the file alone.
//
// What ITK 5.2 does not do by itself, and is done here:
//  - VTK, GIPL and MetaImage: a file that ends too early is read without complaint. A mark in the last bytes of the
//    memory shows whether they were written; MetaIO also prints what it does not report, and that is taken for an
//    error.
//  - NRRD and VTK: memory for all voxels is set to zero first, however few there are: they are counted before.
//  - Text headers with absurd sizes overrun its 32-bit integers, and with long words its buffers: text_header looks
//    first.
//  - NRRD: ITK turns RAS into LPS rightly, but for LAS it changes the sign of x where y is meant.
// Sheared NRRD directions and MetaImage matrices come through as they are.
#include <itkGDCMImageIO.h>
#include <itkGiplImageIO.h>
#include <itkMetaImageIO.h>
#include <itkNrrdImageIO.h>
#include <itkVTKImageIO.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "scantet/base/ascii_text.h"
#include "scantet/base/file_extension.h"
#include "scantet/reading/dicom_outline_impl.h"
#include "scantet/reading/itk_adapter_impl.h"
#include "scantet/reading/nrrd_voxels_impl.h"
#include "scantet/reading/segment_layers_impl.h"

namespace scantet {
namespace {

using IoPointer = itk::ImageIOBase::Pointer;

// `magic` at `offset` must be in the file first: GDCM tries to make sense of anything.
struct Format {
  const char* name;
  IoPointer (*make)();
  std::size_t offset = 0;
  const char* magic = "";
};

bool has_magic(const std::string& path, const Format& format) {
  const std::string magic = format.magic;
  const std::string start = first_bytes(path, format.offset + magic.size());
  return start.size() == format.offset + magic.size() && start.compare(format.offset, magic.size(), magic) == 0;
}

template <class Io>
IoPointer make_io() {
  return IoPointer(Io::New().GetPointer());
}

constexpr Format kFormats[] = {
    {"NRRD", make_io<itk::NrrdImageIO>},
    {"MetaImage", make_io<itk::MetaImageIO>},
    {"VTK", make_io<itk::VTKImageIO>},
    {"GIPL", make_io<itk::GiplImageIO>},
    {"DICOM", make_io<itk::GDCMImageIO>, 128, "DICM"},
};

struct Opened {
  IoPointer io;
  std::string format;
};

// The io that recognises the file; null if none does.
Opened recognise(const std::string& path) {
  for (const Format& format : kFormats) {
    if (!has_magic(path, format)) continue;
    IoPointer io = format.make();
    try {
      if (io->CanReadFile(path.c_str())) return {io, format.name};
    } catch (const itk::ExceptionObject&) {
      continue;  // not its format
    }
  }
  return {};
}

[[noreturn]] void refuse_format(const std::string& path) {
  const std::string start = first_bytes(path, 4);
  if (start == "\x89PNG" || start.rfind("\xff\xd8\xff", 0) == 0 || start.rfind("BM", 0) == 0) {
    throw Error(Fault::input, "input.dimension", "'" + path + "' is a two-dimensional picture (PNG, JPEG or BMP)",
                "stack the slices into one NRRD, NIfTI or multi-page TIFF file");
  }
  if (const std::string problem = gzip_problem(path); !problem.empty()) throw corrupt_file(path, problem);
  throw Error(Fault::input, "input.format", "'" + path + "' is not an image that scantet can read",
              "give NRRD, NHDR, NIfTI, Analyze, MetaImage, a DICOM folder or multi-frame file, a multi-page TIFF, VTK "
              "structured points, GIPL or INRIMAGE (.inr), under its usual file extension");
}

// NRRD's "space: left-anterior-superior".
bool is_las(const std::string& path) {
  std::istringstream lines(first_bytes(path, 1 << 16));
  std::string line;
  while (std::getline(lines, line) && !line.empty() && line != "\r") {
    constexpr std::string_view kKey = "space:";
    const std::string lower = ascii_lower(line);
    if (!lower.starts_with(kKey)) continue;
    const std::string_view space = trimmed(std::string_view(lower).substr(kKey.size()));
    return space == "las" || space == "left-anterior-superior";
  }
  return false;
}

// About the z axis.
void turn_by_half(ImageHeader& header) {
  const auto turn = [](Vec& v) { v = {0 - v.x, 0 - v.y, v.z}; };
  for (Vec& column : header.columns) turn(column);
  turn(header.origin);
}

// Numbers in an ASCII VTK file after the SCALARS line and the LOOKUP_TABLE line that may follow it.
std::int64_t numbers_in_vtk_text(const std::string& path) {
  std::ifstream file(path);
  const auto begins_with = [](const std::string& line, const char* key) { return ascii_lower(line).starts_with(key); };
  std::string line;
  while (std::getline(file, line) && !begins_with(line, "scalars")) {
  }
  const std::streampos voxels = file.tellg();
  if (std::getline(file, line) && !begins_with(line, "lookup_table")) file.seekg(voxels);
  std::int64_t count = 0;
  for (double value = 0; file >> value;) ++count;
  return count;
}

class ItkImage final : public ImageSource {
 public:
  ItkImage(std::string path, Opened opened) : path_(std::move(path)), io_(std::move(opened.io)) {
    io_->SetFileName(path_);
    io_->ReadImageInformation();
    header_ = header_of(*io_, opened.format);
    if (opened.format == "NRRD" && is_las(path_)) turn_by_half(header_);
    if (opened.format == "NRRD") find_segments();
    if (opened.format == "DICOM") set_frame_step();
  }

  const ImageHeader& header() const override { return header_; }

  bool read(void* voxels, Progress& progress) override {
    if (progress.cancelled()) return false;
    const bool text = header_.format == "VTK" && io_->GetFileType() == itk::IOFileEnum::ASCII;
    if (text) check_vtk_numbers();
    if (header_.format == "VTK" && !text) check_vtk_bytes();
    if (header_.format == "NRRD") {
      check_nrrd_voxels(path_, static_cast<std::uint64_t>(io_->GetImageSizeInBytes()),
                        static_cast<std::uint64_t>(io_->GetImageSizeInComponents()));
    }
    const std::string complaints = through_itk(path_, [&](const QuietLibraries& quiet) {
      read_all(*io_, voxels);
      io_ = nullptr;  // some hold a copy of the voxels
      return quiet.said();
    });
    const bool failed = complaints.find("MetaImage: ") != std::string::npos ||
                        complaints.find("Uncompress failed") != std::string::npos;
    if (header_.format == "MetaImage" && failed) throw corrupt_file(path_, complaints);
    return true;
  }

 private:
  void find_segments() {
    double layers = header_.components;
    for (std::size_t axis = 3; axis < header_.size.size(); ++axis) layers *= static_cast<double>(header_.size[axis]);
    constexpr double kMostLayers = 65'534;
    header_.segments = segments_of_slicer(path_, static_cast<std::int64_t>(std::min(layers, kMostLayers)));
    if (!header_.segments.empty()) header_.of_labels = "its header names segments of 3D Slicer (Segment0_ID)";
  }

  // GDCM orders the positions of an enhanced file's frames but not the frames, so it mirrors those that run downwards.
  void set_frame_step() {
    const std::vector<Point> positions = outline_of(path_).frame_positions;
    const std::size_t count = positions.size();
    if (count < 2 || header_.size.size() < 3 || static_cast<std::size_t>(header_.size[2]) != count) return;
    const Vec step = (1.0 / static_cast<double>(count - 1)) * (positions.back() - positions.front());
    constexpr double kEven = 0.1;  // of the step, as for a series
    for (std::size_t k = 0; k < count; ++k) {
      const Point expected = positions.front() + static_cast<double>(k) * step;
      if (distance(positions[k], expected) <= kEven * length(step) && length(step) > 0) continue;
      throw Error(Fault::input, "input.slices",
                  "frame " + std::to_string(k + 1) + " of '" + path_ + "' is not where an even stack would have it",
                  "export one volume with its frames in spatial order");
    }
    header_.columns[2] = step;
    header_.origin = positions.front();
  }

  void check_vtk_numbers() const {
    const auto wanted = static_cast<std::int64_t>(io_->GetImageSizeInComponents());
    const std::int64_t present = numbers_in_vtk_text(path_);
    if (present >= wanted) return;
    throw corrupt_file(path_, std::to_string(present) + " numbers instead of " + std::to_string(wanted));
  }

  // ITK sets memory for all voxels to zero first.
  void check_vtk_bytes() const {
    const auto wanted = static_cast<std::uint64_t>(io_->GetImageSizeInBytes());
    const std::uint64_t whole = std::filesystem::file_size(path_);
    if (whole >= wanted) return;
    throw corrupt_file(path_, "its header asks for " + std::to_string(wanted) + " bytes of voxels, and the file has " +
                                  std::to_string(whole));
  }

  std::string path_;
  IoPointer io_;
  ImageHeader header_;
};

std::optional<VoxelType> voxel_type(itk::IOComponentEnum type) {
  constexpr auto kInteger = [](std::size_t bytes, bool is_signed) {
    const int step = bytes == 1 ? 0 : bytes == 2 ? 1 : bytes == 4 ? 2 : 3;
    return static_cast<VoxelType>(2 * step + (is_signed ? 0 : 1));
  };
  switch (type) {
    case itk::IOComponentEnum::CHAR:
      return VoxelType::int8;
    case itk::IOComponentEnum::UCHAR:
      return VoxelType::uint8;
    case itk::IOComponentEnum::SHORT:
      return VoxelType::int16;
    case itk::IOComponentEnum::USHORT:
      return VoxelType::uint16;
    case itk::IOComponentEnum::INT:
      return VoxelType::int32;
    case itk::IOComponentEnum::UINT:
      return VoxelType::uint32;
    case itk::IOComponentEnum::LONG:
      return kInteger(sizeof(long), true);
    case itk::IOComponentEnum::ULONG:
      return kInteger(sizeof(long), false);
    case itk::IOComponentEnum::LONGLONG:
      return VoxelType::int64;
    case itk::IOComponentEnum::ULONGLONG:
      return VoxelType::uint64;
    case itk::IOComponentEnum::FLOAT:
      return VoxelType::float32;
    case itk::IOComponentEnum::DOUBLE:
      return VoxelType::float64;
    default:
      return std::nullopt;
  }
}

}  // namespace

ImageHeader header_of(const itk::ImageIOBase& io, const std::string& format) {
  ImageHeader header;
  header.format = format;
  const unsigned dimensions = io.GetNumberOfDimensions();
  for (unsigned axis = 0; axis < dimensions; ++axis) {
    header.size.push_back(static_cast<std::int64_t>(io.GetDimensions(axis)));
  }
  header.columns = {Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};
  for (unsigned axis = 0; axis < std::min(dimensions, 3U); ++axis) {
    const std::vector<double> direction = io.GetDirection(axis);
    for (unsigned row = 0; row < 3; ++row) {
      header.columns[axis][static_cast<int>(row)] = row < direction.size() ? io.GetSpacing(axis) * direction[row] : 0;
    }
    header.origin[static_cast<int>(axis)] = io.GetOrigin(axis);
  }
  header.type = voxel_type(io.GetComponentType());
  header.type_name = header.type ? itk::ImageIOBase::GetComponentTypeAsString(io.GetComponentType()) : "unknown";
  header.components = static_cast<int>(io.GetNumberOfComponents());
  header.pixel_kind = itk::ImageIOBase::GetPixelTypeAsString(io.GetPixelType());
  return header;
}

namespace {

// Reads all voxels over a mark in the last bytes. True if a byte of the mark is still there.
bool keeps_mark(itk::ImageIOBase& io, unsigned char* tail, std::size_t length, unsigned char mark) {
  std::fill_n(tail, length, mark);
  void* const voxels = tail + length - static_cast<std::size_t>(io.GetImageSizeInBytes());
  io.Read(voxels);
  return std::find(tail, tail + length, mark) != tail + length;
}

}  // namespace

// Two marks, as the voxels may happen to equal one. Bytes may be swapped within a voxel, so all of its bytes count.
void read_all(itk::ImageIOBase& io, void* voxels) {
  itk::ImageIORegion region(io.GetNumberOfDimensions());
  for (unsigned axis = 0; axis < io.GetNumberOfDimensions(); ++axis) {
    region.SetIndex(axis, 0);
    region.SetSize(axis, io.GetDimensions(axis));
  }
  io.SetIORegion(region);
  const auto length = static_cast<std::size_t>(io.GetComponentSize());
  unsigned char* const tail = static_cast<unsigned char*>(voxels) + io.GetImageSizeInBytes() - length;
  if (keeps_mark(io, tail, length, 0xA5) && keeps_mark(io, tail, length, 0x5A)) {
    throw corrupt_file(io.GetFileName(), "it ends before the last voxel");
  }
}

bool is_itk_image(const std::string& path) {
  if (is_dicom_file(path)) return outline_of(path).has_pixels;
  constexpr std::size_t kGiplMagicAt = 252;
  const std::string start = first_bytes(path, kGiplMagicAt + 4);
  const std::string extension = file_extension(path);
  if (extension == ".gipl") return start.size() > kGiplMagicAt && start.substr(kGiplMagicAt) == "\xef\xff\xe9\xb0";
  if (extension == ".mha" || extension == ".mhd") return start.find("NDims") != std::string::npos;
  const bool points = start.find("STRUCTURED_POINTS") != std::string::npos;
  return start.rfind("NRRD", 0) == 0 || (start.rfind("# vtk DataFile", 0) == 0 && points);
}

std::unique_ptr<ImageSource> open_itk_image(const std::string& path) {
  if (is_dicom_file(path)) {
    const DicomOutline outline = outline_of(path);
    if (!outline.problem.empty()) throw corrupt_file(path, outline.problem);
    if (!outline.has_pixels) {
      throw Error(Fault::input, "input.format", "DICOM file '" + path + "' holds no image",
                  "give an image file, or the folder of a series");
    }
  }
  return through_itk(path, [&](const QuietLibraries&) -> std::unique_ptr<ImageSource> {
    Opened opened = recognise(path);
    if (opened.io.IsNull()) refuse_format(path);
    return std::make_unique<ItkImage>(path, std::move(opened));
  });
}

}  // namespace scantet
