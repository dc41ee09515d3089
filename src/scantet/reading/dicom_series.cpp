// GDCM groups the files of a folder into series; the stacking is done here from Image Position and Image Orientation
// (Patient) alone. ITK's ImageSeriesReader would take the slice normal for the third axis, and so shear off the image
// of a tilted gantry; it would also stack unevenly spaced slices as if they were even. Slices may differ in pixel type
// (a rescale slope each): the series is then read as double, value by value.
#include <itkGDCMImageIO.h>
#include <itkMetaDataObject.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "scantet/reading/dicom_outline_impl.h"
#include "scantet/reading/itk_adapter_impl.h"

namespace scantet {
namespace {

struct Slice {
  std::string file;
  std::string series;
  std::string description;
  std::vector<std::int64_t> size;
  std::optional<VoxelType> type;
  int components = 1;
  std::string pixel_kind;
  Vec row;     // direction of a growing column index
  Vec column;  // direction of a growing row index
  double row_step_mm = 0;
  double column_step_mm = 0;
  Point position;
  bool has_geometry = false;
};

using Series = std::map<std::string, std::vector<Slice>>;  // by Series Instance UID

std::string tag(const itk::GDCMImageIO& io, const std::string& name) {
  std::string value;
  itk::ExposeMetaData<std::string>(io.GetMetaDataDictionary(), name, value);
  value.erase(value.find_last_not_of(std::string("\0 ", 2)) + 1);  // DICOM pads values to an even length
  return value;
}

// "1\-0.5\0" as numbers; empty if it is none.
std::vector<double> numbers(std::string text) {
  std::replace(text.begin(), text.end(), '\\', ' ');
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  std::vector<double> values;
  for (double value = 0; stream >> value;) values.push_back(value);
  return values;
}

itk::GDCMImageIO::Pointer open_slice(const std::string& file) {
  auto io = itk::GDCMImageIO::New();
  io->SetFileName(file);
  io->ReadImageInformation();
  return io;
}

Slice slice_of(const std::string& file) {
  const auto io = open_slice(file);
  const ImageHeader header = header_of(*io, "DICOM");
  Slice slice;
  slice.file = file;
  slice.size = header.size;
  slice.type = header.type;
  slice.components = header.components;
  slice.pixel_kind = header.pixel_kind;
  const std::vector<double> position = numbers(tag(*io, "0020|0032"));
  const std::vector<double> orientation = numbers(tag(*io, "0020|0037"));
  slice.series = tag(*io, "0020|000e");
  slice.description = tag(*io, "0008|103e");
  slice.has_geometry = position.size() == 3 && orientation.size() == 6;
  if (!slice.has_geometry) return slice;
  slice.position = {position[0], position[1], position[2]};
  const Vec row{orientation[0], orientation[1], orientation[2]};
  const Vec column{orientation[3], orientation[4], orientation[5]};
  slice.row = (1 / length(row)) * row;
  slice.column = (1 / length(column)) * column;
  slice.row_step_mm = io->GetSpacing(0);
  slice.column_step_mm = io->GetSpacing(1);
  return slice;
}

[[noreturn]] void refuse_slices(const std::string& what, const std::string& remedy) {
  throw Error(Fault::input, "input.slices", what, remedy);
}

void check_geometry(const std::vector<Slice>& slices) {
  for (const Slice& slice : slices) {
    if (slice.has_geometry) continue;
    refuse_slices("DICOM file '" + slice.file + "' has no Image Position (Patient) and Image Orientation (Patient)",
                  "export the series with its geometry, or convert it to NRRD or NIfTI with the spacing you know");
  }
}

// One size, kind and orientation for all, as the first has it.
void check_alike(const std::vector<Slice>& slices) {
  constexpr double kAlike = 1e-3;  // orientations and pixel spacings are written with few digits
  const Slice& first = slices.front();
  for (const Slice& slice : slices) {
    const bool same_size = slice.size == first.size && slice.components == first.components;
    const bool same_frame = length(slice.row - first.row) < kAlike && length(slice.column - first.column) < kAlike &&
                            std::abs(slice.row_step_mm - first.row_step_mm) < kAlike * first.row_step_mm &&
                            std::abs(slice.column_step_mm - first.column_step_mm) < kAlike * first.column_step_mm;
    if (same_size && same_frame) continue;
    refuse_slices("DICOM slices '" + first.file + "' and '" + slice.file + "' differ in " +
                      (same_size ? "orientation or pixel spacing" : "size"),
                  "keep the slices of one stack in the folder (localizers often share a series)");
  }
}

std::string name_of(const Slice& slice) {
  std::ostringstream text;
  text << "'" << std::filesystem::path(slice.file).filename().string() << "' at (" << slice.position.x << ", "
       << slice.position.y << ", " << slice.position.z << ") mm";
  return text.str();
}

// Refuses a stack with steps that are wider than most, by which slices seem missing.
void check_gaps(const std::string& folder, const std::vector<Slice>& slices) {
  constexpr double kWide = 1.5;  // steps
  std::vector<double> steps;
  for (std::size_t k = 1; k < slices.size(); ++k) {
    steps.push_back(distance(slices[k - 1].position, slices[k].position));
  }
  std::vector<double> sorted = steps;
  std::sort(sorted.begin(), sorted.end());
  const double usual = sorted[(sorted.size() - 1) / 2];
  const auto missing_in = [&](double step) { return step > kWide * usual ? std::lround(step / usual) - 1 : 0; };
  const auto widest = static_cast<std::size_t>(std::max_element(steps.begin(), steps.end()) - steps.begin());
  if (missing_in(steps[widest]) == 0) return;
  long missing = 0;
  const auto gaps = std::count_if(steps.begin(), steps.end(), [&](double step) { return missing_in(step) > 0; });
  for (const double step : steps) missing += missing_in(step);
  std::ostringstream message;
  message << "DICOM folder '" << folder << "' has a gap of " << steps[widest] << " mm between "
          << name_of(slices[widest]) << " and " << name_of(slices[widest + 1]) << "; the other slices are " << usual
          << " mm apart, so " << missing_in(steps[widest]) << " of them "
          << (missing_in(steps[widest]) == 1 ? "seems" : "seem") << " missing there";
  if (gaps > 1) message << ", and " << missing << " in all " << gaps << " gaps";
  refuse_slices(
      message.str(),
      "add the missing slices (copy or export the series again), or mesh the slices of one side of the gap in "
      "a folder of their own; what is lost can be filled in by resampling, in 3D Slicer say, and saved as NRRD");
}

// The slices sorted along their normal must be one straight, even stack.
void check_even(const std::string& folder, const std::vector<Slice>& slices) {
  constexpr double kSamePlace = 1e-3;  // mm
  constexpr double kEven = 0.1;        // of the step between slices: positions are often rounded to a tenth
  const auto count = slices.size();
  std::size_t places = 1;
  for (std::size_t k = 1; k < count; ++k) {
    if (distance(slices[k].position, slices[k - 1].position) > kSamePlace) ++places;
  }
  if (places < count) {
    throw Error(Fault::input, "input.dimension",
                "DICOM folder '" + folder + "' has " + std::to_string(count) + " slices at " + std::to_string(places) +
                    " positions: more than one volume, or duplicates",
                "keep one volume's slices in the folder (one echo, phase or time)");
  }
  const Vec step = (1.0 / static_cast<double>(count - 1)) * (slices.back().position - slices.front().position);
  for (std::size_t k = 0; k < count; ++k) {
    const Point expected = slices.front().position + static_cast<double>(k) * step;
    const double off_mm = distance(slices[k].position, expected);
    if (off_mm <= kEven * length(step)) continue;
    check_gaps(folder, slices);
    std::ostringstream message;
    message << "DICOM slice '" << slices[k].file << "' lies " << off_mm << " mm off an even stack of " << count
            << " slices " << length(step) << " mm apart";
    refuse_slices(message.str(), "resample the series to even spacing, in 3D Slicer say, and save it as NRRD");
  }
}

void to_double(VoxelType type, const void* from, std::int64_t count, double* to) {
  const auto copy = [&](auto* values) { std::copy_n(values, count, to); };
  switch (type) {
    case VoxelType::int8:
      return copy(static_cast<const std::int8_t*>(from));
    case VoxelType::uint8:
      return copy(static_cast<const std::uint8_t*>(from));
    case VoxelType::int16:
      return copy(static_cast<const std::int16_t*>(from));
    case VoxelType::uint16:
      return copy(static_cast<const std::uint16_t*>(from));
    case VoxelType::int32:
      return copy(static_cast<const std::int32_t*>(from));
    case VoxelType::uint32:
      return copy(static_cast<const std::uint32_t*>(from));
    case VoxelType::int64:
      return copy(static_cast<const std::int64_t*>(from));
    case VoxelType::uint64:
      return copy(static_cast<const std::uint64_t*>(from));
    case VoxelType::float32:
      return copy(static_cast<const float*>(from));
    case VoxelType::float64:
      return copy(static_cast<const double*>(from));
  }
}

class DicomSeries final : public ImageSource {
 public:
  DicomSeries(const std::string& folder, std::vector<Slice> slices) : slices_(std::move(slices)) {
    check_geometry(slices_);
    check_alike(slices_);
    const Vec normal = cross(slices_.front().row, slices_.front().column);
    std::stable_sort(slices_.begin(), slices_.end(),
                     [&](const Slice& a, const Slice& b) { return dot(a.position - b.position, normal) < 0; });
    const Slice& first = slices_.front();
    const auto count = slices_.size();
    Vec step = normal;
    if (count > 1) {
      check_even(folder, slices_);
      step = (1.0 / static_cast<double>(count - 1)) * (slices_.back().position - first.position);
    }
    header_.format = "DICOM";
    header_.size = {first.size[0], first.size[1], static_cast<std::int64_t>(count)};
    header_.columns = {first.row_step_mm * first.row, first.column_step_mm * first.column, step};
    header_.origin = first.position;
    header_.components = first.components;
    header_.pixel_kind = first.pixel_kind;
    header_.type = first.type;
    for (const Slice& slice : slices_) {
      if (!slice.type || !header_.type) {
        header_.type.reset();
      } else if (slice.type != first.type) {
        header_.type = VoxelType::float64;
      }
    }
  }

  const ImageHeader& header() const override { return header_; }

  bool read(void* voxels, Progress& progress) override {
    const std::int64_t voxels_of_slice = header_.size[0] * header_.size[1];
    const std::int64_t bytes_of_slice = voxels_of_slice * voxel_bytes(*header_.type);
    auto* place = static_cast<unsigned char*>(voxels);
    std::vector<unsigned char> raw;
    for (std::size_t k = 0; k < slices_.size(); ++k, place += bytes_of_slice) {
      if (progress.cancelled()) return false;
      progress.report({"read", "slices", k, slices_.size(), 0});
      const Slice& slice = slices_[k];
      through_itk(slice.file, [&](const QuietLibraries&) {
        const auto io = open_slice(slice.file);
        if (slice.type == header_.type) {
          read_all(*io, place);
        } else {
          raw.resize(static_cast<std::size_t>(voxels_of_slice * voxel_bytes(*slice.type)));
          read_all(*io, raw.data());
          to_double(*slice.type, raw.data(), voxels_of_slice, reinterpret_cast<double*>(place));
        }
      });
    }
    return true;
  }

 private:
  std::vector<Slice> slices_;
  ImageHeader header_;
};

// "UID (12 slices, CT thorax), …"
std::string list_of(const Series& series) {
  std::string list;
  for (const auto& [uid, slices] : series) {
    const std::string& description = slices.front().description;
    list += (list.empty() ? "" : ", ") + uid + " (" + std::to_string(slices.size()) + " slices" +
            (description.empty() ? "" : ", " + description) + ")";
  }
  return list;
}

// Images in the order of their names; other DICOM objects (directories, reports) and other files are passed over.
std::vector<std::string> images_in(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_regular_file() && is_dicom_file(entry.path().string())) files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Null if cancelled.
std::optional<Series> read_headers(const std::string& folder, Progress& progress) {
  const std::vector<std::string> files = images_in(folder);
  Series series;
  for (std::size_t k = 0; k < files.size(); ++k) {
    if (progress.cancelled()) return std::nullopt;
    progress.report({"read", "headers", k, files.size(), 0});
    const DicomOutline outline = outline_of(files[k]);
    if (!outline.problem.empty()) throw corrupt_file(files[k], outline.problem);
    if (!outline.has_pixels) continue;
    Slice slice = through_itk(files[k], [&](const QuietLibraries&) { return slice_of(files[k]); });
    series[slice.series].push_back(std::move(slice));
  }
  return series;
}

std::vector<Slice> chosen_series(const std::string& folder, const std::string& uid, const Series& series) {
  if (series.empty()) {
    throw Error(Fault::input, "input.format", "folder '" + folder + "' holds no DICOM image",
                "name the folder that directly holds the slices, or an image file");
  }
  if (const auto exact = series.find(uid); exact != series.end()) return exact->second;
  const std::vector<Slice>* chosen = nullptr;
  int matches = 0;
  for (const auto& [name, slices] : series) {
    if (name.rfind(uid, 0) != 0) continue;
    chosen = &slices;
    ++matches;
  }
  if (matches == 1) return *chosen;
  const std::string found = std::to_string(series.size()) + " DICOM series: " + list_of(series);
  throw Error(Fault::input, "input.series",
              matches == 0 ? "folder '" + folder + "' has no series '" + uid + "' among " + found
                           : "folder '" + folder + "' holds " + found,
              "choose one with '" + folder + ":UID'");
}

}  // namespace

std::unique_ptr<ImageSource> open_dicom_series(const std::string& folder, const std::string& uid, Progress& progress) {
  const std::optional<Series> series = read_headers(folder, progress);
  if (!series) return nullptr;
  std::vector<Slice> slices = chosen_series(folder, uid, *series);
  if (slices.size() == 1) return open_itk_image(slices.front().file);
  for (const Slice& slice : slices) {
    if (slice.size.size() < 3 || slice.size[2] == 1) continue;
    throw Error(Fault::input, "input.dimension",
                "DICOM folder '" + folder + "' holds several multi-frame files, each a volume of its own",
                "name the file of one volume");
  }
  return std::make_unique<DicomSeries>(folder, std::move(slices));
}

}  // namespace scantet
