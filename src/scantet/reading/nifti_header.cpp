// The format is one 348-byte header and plain voxels: fields are taken by their offsets in nifti1.h, and swapped if
// sizeof_hdr says so. Analyze has the same layout up to the orientation fields, which are left alone: it gives the
// spacing only.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "scantet/base/regular_file.h"
#include "scantet/reading/nifti_header_impl.h"

namespace scantet {
namespace {

constexpr int kHeaderBytesNifti2 = 540;

/// The header's bytes, and its fields by their offsets.
class RawHeader {
 public:
  // False if the file is not that long, or no header in either byte order.
  bool load(const std::string& path) {
    check_regular_file(path);
    const GzPointer file(gzopen(path.c_str(), "rb"));
    if (!file || gzread(file.get(), bytes_.data(), kNiftiHeaderBytes) != kNiftiHeaderBytes) return false;
    swapped_ = at<std::int32_t>(0) != kNiftiHeaderBytes;
    return at<std::int32_t>(0) == kNiftiHeaderBytes;
  }

  template <class T>
  T at(std::size_t offset) const {
    std::array<unsigned char, sizeof(T)> raw;
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset), sizeof(T), raw.begin());
    if (swapped_) std::reverse(raw.begin(), raw.end());
    T value;
    std::memcpy(&value, raw.data(), sizeof(T));
    return value;
  }
  double real(std::size_t offset) const { return at<float>(offset); }
  int whole(std::size_t offset) const { return at<std::int16_t>(offset); }
  bool swapped() const { return swapped_; }
  std::string magic() const { return {reinterpret_cast<const char*>(bytes_.data()) + 344, 3}; }

 private:
  std::array<unsigned char, kNiftiHeaderBytes> bytes_{};
  bool swapped_ = false;
};

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// The other file of a .hdr/.img pair, compressed or not; the path itself if it does not end in `from`, "" if none is
// there.
std::string partner(const std::string& path, const std::string& from, const std::string& to) {
  for (const char* packed : {"", ".gz"}) {
    const std::string end = from + packed;
    if (!ends_with(path, end)) continue;
    const std::string stem = path.substr(0, path.size() - end.size());
    for (const char* other : {"", ".gz"}) {
      if (std::filesystem::exists(stem + to + other)) return stem + to + other;
    }
    return {};
  }
  return path;
}

bool is_nifti_magic(const std::string& magic) {
  return magic == "n+1" || magic == "ni1";
}

double unit_mm(int xyzt_units) {
  constexpr int kSpaceBits = 0x07;
  switch (xyzt_units & kSpaceBits) {
    case 1:
      return 1000;  // metre
    case 3:
      return 0.001;  // micron
    default:
      return 1;  // millimetre, or not said
  }
}

struct Affine {
  std::array<Vec, 3> columns;
  Point origin;
};

// The frame by method 3.
Affine sform(const RawHeader& raw) {
  Affine affine;
  for (int row = 0; row < 3; ++row) {
    const std::size_t first = 280 + 16 * static_cast<std::size_t>(row);
    for (int k = 0; k < 3; ++k) affine.columns[k][row] = raw.real(first + 4 * static_cast<std::size_t>(k));
    affine.origin[row] = raw.real(first + 12);
  }
  return affine;
}

// The frame by method 2: a quaternion (a, b, c, d) of which a ≥ 0 is left out, spacing, and a mirror along k.
Affine qform(const RawHeader& raw, const Vec& spacing) {
  double b = raw.real(256);
  double c = raw.real(260);
  double d = raw.real(264);
  double a = 1 - (b * b + c * c + d * d);
  constexpr double kHalfTurn = 1e-7;  // below it `a` is rounding: a turn by 180°, and (b, c, d) needs normalising
  if (a < kHalfTurn) {
    const double scale = 1 / std::sqrt(b * b + c * c + d * d);
    b *= scale;
    c *= scale;
    d *= scale;
    a = 0;
  } else {
    a = std::sqrt(a);
  }
  const double mirror = raw.real(76) < 0 ? -1 : 1;
  return {{spacing.x * Vec{a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)},
           spacing.y * Vec{2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b)},
           mirror * spacing.z * Vec{2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - b * b - c * c}},
          {raw.real(268), raw.real(272), raw.real(276)}};
}

// The frame, LPS, in the header's units.
Affine affine_of(const RawHeader& raw, bool analyze) {
  Vec spacing;
  for (int axis = 0; axis < 3; ++axis) {
    const double step = std::abs(raw.real(80 + 4 * static_cast<std::size_t>(axis)));
    spacing[axis] = step > 0 ? step : 1;  // as the reference library does
  }
  const bool has_qform = !analyze && raw.whole(252) > 0;
  const bool has_sform = !analyze && raw.whole(254) > 0;
  if (!has_sform && !has_qform) {
    return {{Vec{spacing.x, 0, 0}, Vec{0, spacing.y, 0}, Vec{0, 0, spacing.z}}, {}};
  }
  Affine affine = has_sform ? sform(raw) : qform(raw, spacing);
  const auto ras_to_lps = [](Vec& v) { v = {0 - v.x, 0 - v.y, v.z}; };  // no -0
  for (Vec& column : affine.columns) ras_to_lps(column);
  ras_to_lps(affine.origin);
  return affine;
}

void set_type(int datatype, ImageHeader& header) {
  header.type_name = "NIfTI datatype " + std::to_string(datatype);
  const auto several = [&](int components, const char* kind) {
    header.components = components;
    header.pixel_kind = kind;
  };
  switch (datatype) {
    case 2:
      header.type = VoxelType::uint8;
      break;
    case 4:
      header.type = VoxelType::int16;
      break;
    case 8:
      header.type = VoxelType::int32;
      break;
    case 16:
      header.type = VoxelType::float32;
      break;
    case 64:
      header.type = VoxelType::float64;
      break;
    case 256:
      header.type = VoxelType::int8;
      break;
    case 512:
      header.type = VoxelType::uint16;
      break;
    case 768:
      header.type = VoxelType::uint32;
      break;
    case 1024:
      header.type = VoxelType::int64;
      break;
    case 1280:
      header.type = VoxelType::uint64;
      break;
    case 32:
    case 1792:
    case 2048:
      several(2, "complex");
      break;
    case 128:
      several(3, "rgb");
      break;
    case 2304:
      several(4, "rgba");
      break;
    default:
      break;
  }
}

// dim[4] counts times, dim[5] the values of a vector.
void set_size(const RawHeader& raw, const std::string& path, ImageHeader& header) {
  const int axes = raw.whole(40);
  if (axes < 1 || axes > 7) throw corrupt_file(path, "the header states " + std::to_string(axes) + " axes");
  for (int axis = 1; axis <= axes; ++axis) {
    const int size = raw.whole(40 + 2 * static_cast<std::size_t>(axis));
    if (size < 1) throw corrupt_file(path, "the header states an axis of " + std::to_string(size) + " voxels");
    header.size.push_back(size);
  }
  constexpr int kVectorIntent = 1007;
  if (header.size.size() > 4 && header.size[4] > 1 && (raw.whole(68) == kVectorIntent || header.size[3] == 1)) {
    header.components *= static_cast<int>(header.size[4]);
    header.pixel_kind = "vector";
    header.size.resize(4);
  }
}

/// A slope of 0 means that the values are as stored (nifti1.h, "DATA SCALING").
void set_scale(const RawHeader& raw, NiftiHeader& header) {
  header.slope = raw.real(112);
  header.intercept = raw.real(116);
  if (header.slope == 0 || !std::isfinite(header.slope) || !std::isfinite(header.intercept)) return;
  header.scaled = header.slope != 1 || header.intercept != 0;
  constexpr int kFloatDigits = 16;  // bits of an integer that a float holds for sure, with room for the scale
  const bool wide = 8 * voxel_bytes(header.stored) > kFloatDigits && header.stored != VoxelType::float32;
  if (header.scaled) header.image.type = wide ? VoxelType::float64 : VoxelType::float32;
}

/// The header's fields but for where the voxels are.
void set_image(const RawHeader& raw, bool analyze, const std::string& path, ImageHeader& image) {
  image.format = analyze ? "Analyze" : "NIfTI";
  constexpr int kLabelIntent = 1002;
  if (!analyze && raw.whole(68) == kLabelIntent) image.of_labels = "its NIfTI intent is 1002, NIFTI_INTENT_LABEL";
  set_type(raw.whole(70), image);
  set_size(raw, path, image);
  const Affine affine = affine_of(raw, analyze);
  const double unit = analyze ? 1 : unit_mm(raw.at<std::uint8_t>(123));
  for (int axis = 0; axis < 3; ++axis) image.columns[axis] = unit * affine.columns[axis];
  image.origin = unit * affine.origin;
}

}  // namespace

NiftiHeader read_nifti_header(const std::string& path) {
  const std::string header_file = partner(path, ".img", ".hdr");
  RawHeader raw;
  if (!raw.load(header_file)) throw corrupt_file(path, "no header");
  const bool analyze = !is_nifti_magic(raw.magic());
  const bool pair = raw.magic() != "n+1";
  NiftiHeader header;
  header.voxel_file = pair ? partner(header_file, ".hdr", ".img") : header_file;
  if (header.voxel_file.empty()) throw corrupt_file(path, "the .img file beside it is missing");
  check_regular_file(header.voxel_file);
  constexpr double kFarthest = 1e9;
  const double offset = raw.real(108);
  header.offset = std::max<std::int64_t>(offset < kFarthest ? static_cast<std::int64_t>(offset) : 0, pair ? 0 : 352);
  header.swapped = raw.swapped();
  set_image(raw, analyze, path, header.image);
  if (header.image.type) {
    header.stored = *header.image.type;
    if (!analyze) set_scale(raw, header);
  }
  return header;
}

bool is_nifti_file(const std::string& path) {
  RawHeader raw;
  const std::string header_file = partner(path, ".img", ".hdr");
  if (header_file.empty() || !raw.load(header_file)) return false;
  return is_nifti_magic(raw.magic()) || ends_with(header_file, ".hdr") || ends_with(header_file, ".hdr.gz");
}

bool is_nifti_2_file(const std::string& path) {
  std::array<unsigned char, 12> raw{};
  const GzPointer file(gzopen(path.c_str(), "rb"));
  if (!file || gzread(file.get(), raw.data(), raw.size()) != static_cast<int>(raw.size())) return false;
  const auto size = [&](int a, int b, int c, int d) { return raw[a] | raw[b] << 8 | raw[c] << 16 | raw[d] << 24; };
  const std::string magic(reinterpret_cast<const char*>(raw.data()) + 4, 3);
  return (size(0, 1, 2, 3) == kHeaderBytesNifti2 || size(3, 2, 1, 0) == kHeaderBytesNifti2) &&
         (magic == "n+2" || magic == "ni2");
}

}  // namespace scantet
