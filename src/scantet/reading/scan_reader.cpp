// read_scan finds the source for the path, judges its header, gives it memory, and looks at every value once. All
// refusals that do not depend on the format are made here, in the order: kind of pixel, dimensions, frame, memory,
// values.
#include "scantet/reading/scan_reader.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "scantet/base/file_extension.h"
#include "scantet/base/memory.h"
#include "scantet/base/regular_file.h"
#include "scantet/field/scan_from_memory.h"
#include "scantet/reading/image_source_impl.h"
#include "scantet/reading/segment_layers_impl.h"
#include "scantet/reading/text_header_impl.h"

namespace scantet {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const char* code, const std::string& what, const std::string& remedy) {
  throw Error(Fault::input, code, what, remedy);
}

// A file, or a folder and perhaps the identifier of a series in it.
struct Place {
  std::string path;
  std::string series;
  bool folder = false;
};

Place locate(const std::string& path) {
  std::error_code failure;
  if (fs::is_directory(path, failure)) return {path, "", true};
  if (fs::exists(path, failure)) return {path, "", false};
  const std::size_t colon = path.rfind(':');
  if (colon != std::string::npos && colon > 0 && fs::is_directory(path.substr(0, colon), failure)) {
    return {path.substr(0, colon), path.substr(colon + 1), true};
  }
  refuse("input.not_found", "'" + path + "' does not exist", "check the path; a DICOM series is FOLDER or FOLDER:UID");
}

std::unique_ptr<ImageSource> open_source(const Place& place, Progress& progress) {
  if (place.folder) {
    const auto series = [&](Progress& reported) { return open_dicom_series(place.path, place.series, reported); };
    return open_apart(place.path, series, progress);
  }
  check_regular_file(place.path);
  std::error_code failure;
  if (!std::ifstream(place.path, std::ios::binary)) {
    refuse("input.not_found", "'" + place.path + "' cannot be opened for reading", "check its permissions");
  }
  if (fs::file_size(place.path, failure) == 0) {
    refuse("input.empty", "'" + place.path + "' is empty (0 bytes)", "copy or export the image again");
  }
  if (is_nifti_file(place.path)) return open_nifti_image(place.path);
  check_text_header(place.path);
  const auto open = is_tiff_file(place.path)            ? open_tiff_stack
                    : is_inr_image(place.path)          ? open_inr_image
                    : is_dicom_segmentation(place.path) ? open_dicom_segmentation
                                                        : open_itk_image;
  return open_apart(
      place.path, [&](Progress&) { return open(place.path); }, progress);
}

/// How many volumes there are along the axes behind the third one.
double volumes_of(const ImageHeader& header) {
  double volumes = 1;
  for (std::size_t axis = 3; axis < header.size.size(); ++axis) volumes *= static_cast<double>(header.size[axis]);
  return volumes;
}

/// What the file holds of each place: one value, layers of a segmentation, or, if they are asked for, several volumes.
struct Layout {
  std::int64_t layers = 1;
  bool interleaved = false;  ///< the layers' values of a voxel lie side by side
  bool is_segmentation = false;
};

/// Whether values of this type may be probabilities: whole numbers other than bytes are none.
bool may_be_share(const ImageHeader& header) {
  return header.type == VoxelType::float32 || header.type == VoxelType::float64 || header.type == VoxelType::uint8;
}

/// several: whether volumes may be.
Layout layout_of(const ImageHeader& header, bool several) {
  constexpr double kMostLayers = 65'534;  // so that 16 bits number them and the background
  const double volumes = volumes_of(header);
  const bool side_by_side = header.components > 1 && volumes == 1 && header.pixel_kind == "vector";
  const bool one_behind_another = header.components == 1 && volumes > 1;
  const double layers = header.components * volumes;
  Layout layout;
  layout.is_segmentation = header.format == "NRRD" && !header.segments.empty();
  if ((!side_by_side && !one_behind_another) || layers > kMostLayers) return layout;
  if (!layout.is_segmentation && !(several && may_be_share(header))) return layout;
  layout.layers = static_cast<std::int64_t>(layers);
  layout.interleaved = side_by_side;
  return layout;
}

void check_pixels(const ImageHeader& header, const Layout& layout, const std::string& path) {
  if ((header.components != 1 && !layout.interleaved) || header.pixel_kind == "complex") {
    refuse("input.pixel_type",
           "'" + path + "' has " + std::to_string(header.components) + " values per voxel (" + header.pixel_kind +
               "); scantet takes one",
           "extract one channel, or the magnitude");
  }
  if (!header.type) {
    refuse("input.pixel_type", "'" + path + "' has voxels of type '" + header.type_name + "'",
           "convert them to an 8- to 64-bit integer, float or double");
  }
}

std::string size_text(const std::vector<std::int64_t>& size) {
  std::string text;
  for (const std::int64_t n : size) text += (text.empty() ? "" : " x ") + std::to_string(n);
  return text;
}

void check_dimensions(const ImageHeader& header, const Layout& layout, const std::string& path) {
  const std::string image = "'" + path + "' (" + size_text(header.size) + " voxels)";
  const std::string stack = header.format == "DICOM" ? "give the folder that holds all slices of the series"
                                                     : "stack the slices into one three-dimensional file";
  if (header.size.size() < 3) refuse("input.dimension", image + " is two-dimensional", stack);
  if (const double volumes = volumes_of(header); volumes != 1 && layout.layers == 1) {
    std::ostringstream count;
    count << volumes;
    refuse("input.dimension", image + " holds " + count.str() + " volumes",
           "extract one volume, for example with 'fslroi IN OUT 0 1' or 3D Slicer");
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (header.size[axis] >= 2) continue;
    refuse("input.dimension",
           image + " is " + std::to_string(header.size[axis]) + " voxel thick along axis " + std::to_string(axis + 1) +
               "; at least 2 are needed",
           stack);
  }
}

void check_memory(const ImageHeader& header, const std::string& path) {
  double bytes = double(voxel_bytes(*header.type)) * header.components;
  for (const std::int64_t n : header.size) bytes *= static_cast<double>(n);
  const bool axes_fit = std::all_of(header.size.begin(), header.size.end(),
                                    [](std::int64_t n) { return n <= std::numeric_limits<int>::max(); });
  if (axes_fit && bytes <= physical_bytes()) return;
  constexpr double kGiga = 1e9;
  std::ostringstream message;
  message.precision(4);
  message << "'" << path << "' announces " << size_text(header.size) << " voxels of "
          << pixel_type_name(static_cast<std::size_t>(*header.type)) << ", " << bytes / kGiga
          << " GB; this machine has " << physical_bytes() / kGiga << " GB";
  refuse("input.too_large", message.str(), "crop or resample the image, or correct its header");
}

Frame frame_of(const ImageHeader& header, const std::string& path) {
  try {
    return {header.columns, header.origin};
  } catch (const Error& error) {
    refuse(error.code().c_str(),
           "in '" + path + "' the image's axes do not span space (zero, infinite or parallel steps)", error.remedy());
  }
}

template <class T>
void give_memory(Scan& scan, std::int64_t layers, void*& voxels) {
  auto memory = std::make_shared_for_overwrite<T[]>(static_cast<std::size_t>(scan.voxel_count() * layers));
  voxels = memory.get();
  scan.voxels = static_cast<const T*>(memory.get());
  scan.owner = std::move(memory);
}

/// For so many layers of the scan's size.
void* allocate(Scan& scan, VoxelType type, std::int64_t layers, const std::string& path) {
  void* voxels = nullptr;
  try {
    switch (type) {
      case VoxelType::int8:
        give_memory<std::int8_t>(scan, layers, voxels);
        break;
      case VoxelType::uint8:
        give_memory<std::uint8_t>(scan, layers, voxels);
        break;
      case VoxelType::int16:
        give_memory<std::int16_t>(scan, layers, voxels);
        break;
      case VoxelType::uint16:
        give_memory<std::uint16_t>(scan, layers, voxels);
        break;
      case VoxelType::int32:
        give_memory<std::int32_t>(scan, layers, voxels);
        break;
      case VoxelType::uint32:
        give_memory<std::uint32_t>(scan, layers, voxels);
        break;
      case VoxelType::int64:
        give_memory<std::int64_t>(scan, layers, voxels);
        break;
      case VoxelType::uint64:
        give_memory<std::uint64_t>(scan, layers, voxels);
        break;
      case VoxelType::float32:
        give_memory<float>(scan, layers, voxels);
        break;
      case VoxelType::float64:
        give_memory<double>(scan, layers, voxels);
        break;
    }
  } catch (const std::bad_alloc&) {
    refuse("input.too_large", "no memory for the " + std::to_string(scan.voxel_count()) + " voxels of '" + path + "'",
           "free memory, or crop or resample the image");
  }
  return voxels;
}

/// The volumes of an image, whose voxels are those of `all`, one volume after another or side by side.
std::vector<Scan> volumes_in(const Scan& all, const Layout& layout) {
  const auto count = static_cast<std::size_t>(all.voxel_count());
  const auto layers = static_cast<std::size_t>(layout.layers);
  std::vector<Scan> volumes(layers, all);
  std::visit(
      [&]<class Voxel>(const Voxel* values) {
        for (std::size_t n = 0; n < layers; ++n) {
          if (!layout.interleaved) {
            volumes[n].voxels = values + n * count;
            continue;
          }
          auto own = std::make_shared_for_overwrite<Voxel[]>(count);
          for (std::size_t at = 0; at < count; ++at) own[at] = values[at * layers + n];
          volumes[n].voxels = static_cast<const Voxel*>(own.get());
          volumes[n].owner = std::move(own);
        }
      },
      all.voxels);
  return volumes;
}

/// All that the file holds; none if cancelled. several: whether it may be more than one volume.
std::vector<Scan> read_file(const std::string& path, Progress& progress, bool may_be_constant, bool several) {
  if (progress.cancelled()) return {};
  progress.report({"read", "header", 0, std::nullopt, 0});
  const std::unique_ptr<ImageSource> source = open_source(locate(path), progress);
  if (!source) return {};
  const ImageHeader& header = source->header();
  const Layout layout = layout_of(header, several);
  check_pixels(header, layout, path);
  check_dimensions(header, layout, path);
  Scan scan;
  scan.frame = frame_of(header, path);
  check_memory(header, path);
  for (int axis = 0; axis < 3; ++axis) scan.size[axis] = static_cast<int>(header.size[axis]);
  scan.format = header.format;
  scan.header_of_labels = header.of_labels;
  void* voxels = allocate(scan, *header.type, layout.layers, path);
  const auto count = static_cast<std::uint64_t>(scan.voxel_count() * layout.layers);
  progress.report({"read", "voxels", 0, count, 0});
  if (!source->read(voxels, progress)) return {};
  for (const HeaderSegment& named : header.segments) scan.segments.push_back(named.segment);
  scan.overlapping = source->overlapping();
  if (layout.layers > 1 && layout.is_segmentation) {
    Scan merged = merge_layers(scan.voxels, scan.size, scan.frame, header.segments, layout.layers, layout.interleaved,
                               path, may_be_constant);
    merged.format = scan.format;
    merged.header_of_labels = scan.header_of_labels;
    return {merged};
  }
  std::vector<Scan> volumes = layout.layers == 1 ? std::vector{scan} : volumes_in(scan, layout);
  for (std::size_t n = 0; n < volumes.size(); ++n) {
    const std::string which = volumes.size() > 1 ? "volume " + std::to_string(n + 1) + " of " : "";
    look_at_voxels(volumes[n], which + "'" + path + "'", may_be_constant || volumes.size() > 1);
  }
  if (layout.is_segmentation) check_labels(volumes.front(), path);
  progress.report({"read", "voxels", count, count, 0});
  return volumes;
}

bool has_scan_extension(const fs::path& path) {
  static constexpr const char* kExtensions[] = {".nrrd", ".nhdr", ".nii",  ".hdr", ".img", ".mha",  ".mhd",
                                                ".dcm",  ".tif",  ".tiff", ".vtk", ".mnc", ".gipl", ".inr"};
  const std::string extension = file_extension(path.extension() == ".gz" ? path.stem() : path);
  return std::find(std::begin(kExtensions), std::end(kExtensions), extension) != std::end(kExtensions);
}

bool holds_dicom(const std::string& folder) {
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure)) {
    if (entry.is_regular_file(failure) && is_dicom_file(entry.path().string())) return true;
  }
  return false;
}

}  // namespace

int voxel_bytes(VoxelType type) {
  constexpr int kBytes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kBytes[static_cast<int>(type)];
}

std::optional<VoxelType> voxel_type(std::size_t bytes, bool is_real, bool is_signed) {
  switch (bytes) {
    case 1:
      return is_real ? std::nullopt : std::optional(is_signed ? VoxelType::int8 : VoxelType::uint8);
    case 2:
      return is_real ? std::nullopt : std::optional(is_signed ? VoxelType::int16 : VoxelType::uint16);
    case 4:
      return is_real ? VoxelType::float32 : is_signed ? VoxelType::int32 : VoxelType::uint32;
    case 8:
      return is_real ? VoxelType::float64 : is_signed ? VoxelType::int64 : VoxelType::uint64;
    default:
      return std::nullopt;
  }
}

std::string first_bytes(const std::string& path, std::size_t count) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes(count, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return bytes;
}

Error corrupt_file(const std::string& path, const std::string& reason) {
  std::istringstream words(reason);
  std::string line;
  std::string word;
  constexpr std::size_t kLongest = 300;
  while (words >> word && line.size() + word.size() < kLongest) {
    if (word == "itk::ERROR:" || word.find("(0x") != std::string::npos) continue;  // class names and addresses
    line += (line.empty() ? "" : " ") + word;
  }
  return {Fault::input, "input.corrupt", "'" + path + "' is truncated or damaged" + (line.empty() ? "" : ": " + line),
          "copy or export the image again"};
}

int can_read_scan(const std::string& path) {
  try {
    const Place place = locate(path);
    if (place.folder) return holds_dicom(place.path) ? 100 : 10;
    if (!fs::is_regular_file(path)) return 0;
    if (is_tiff_file(path) || is_dicom_file(path) || is_nifti_file(path) || is_inr_image(path) || is_itk_image(path))
      return 100;
  } catch (const std::exception&) {
    // Not there or not readable: the name decides, so that read_scan can say what is wrong.
  }
  return has_scan_extension(path) ? 20 : 0;
}

Scan read_scan(const std::string& path, Progress& progress, bool may_be_constant) {
  const std::vector<Scan> read = read_file(path, progress, may_be_constant, false);
  return read.empty() ? Scan() : read.front();
}

std::vector<Scan> read_volumes(const std::string& path, Progress& progress, bool may_be_constant) {
  return read_file(path, progress, may_be_constant, true);
}

}  // namespace scantet
