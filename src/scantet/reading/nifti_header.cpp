// The format is one header, of 348 bytes or in NIfTI-2 540, and plain voxels: fields are taken by their offsets in
// nifti1.h and nifti2.h, and swapped if sizeof_hdr says so. Analyze has the layout of NIfTI-1 up to the orientation
// fields, which are left alone: it gives the spacing only.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>

#include "scantet/base/regular_file.h"
#include "scantet/reading/nifti_header_impl.h"

namespace scantet {
namespace {

constexpr int kHeaderBytesNifti2 = 540;

/// Where the fields of a header begin. In NIfTI-2 real numbers have 8 bytes instead of 4, sizes 8 instead of 2, and
/// codes 4 instead of 2.
struct Layout {
  std::size_t magic, datatype, dim, pixdim, offset, slope, intercept, qform, sform, quaternion, q_offset, s_rows, units,
      intent;
};
constexpr Layout kNifti1{344, 70, 40, 76, 108, 112, 116, 252, 254, 256, 268, 280, 123, 68};
constexpr Layout kNifti2{4, 12, 16, 104, 168, 176, 184, 344, 348, 352, 376, 400, 500, 504};

/// The header's bytes, and its fields by their offsets.
class RawHeader {
 public:
  // False if the file is not that long, or no header in either byte order.
  bool load(const std::string& path) {
    check_regular_file(path);
    const GzPointer file(gzopen(path.c_str(), "rb"));
    if (!file || gzread(file.get(), bytes_.data(), kNiftiHeaderBytes) != kNiftiHeaderBytes) return false;
    const auto states = [this](int bytes) {
      for (const bool swapped : {false, true}) {
        swapped_ = swapped;
        if (at<std::int32_t>(0) == bytes) return true;
      }
      return false;
    };
    if (states(kNiftiHeaderBytes)) return true;
    constexpr int kRest = kHeaderBytesNifti2 - kNiftiHeaderBytes;
    wide_ = true;
    return states(kHeaderBytesNifti2) && (magic() == "n+2" || magic() == "ni2") &&
           gzread(file.get(), bytes_.data() + kNiftiHeaderBytes, kRest) == kRest;
  }

  const Layout& fields() const { return wide_ ? kNifti2 : kNifti1; }
  /// The n-th real number from the offset on.
  double real(std::size_t offset, std::size_t n = 0) const {
    return wide_ ? at<double>(offset + 8 * n) : at<float>(offset + 4 * n);
  }
  int code(std::size_t offset) const { return wide_ ? at<std::int32_t>(offset) : at<std::int16_t>(offset); }
  int datatype() const { return at<std::int16_t>(fields().datatype); }
  std::int64_t dim(std::size_t n) const {
    return wide_ ? at<std::int64_t>(fields().dim + 8 * n) : at<std::int16_t>(fields().dim + 2 * n);
  }
  int units() const { return wide_ ? at<std::int32_t>(fields().units) : at<std::uint8_t>(fields().units); }
  /// Where the voxels begin in a file that has the header, too, at least.
  std::int64_t least_offset() const { return wide_ ? 544 : 352; }
  double offset() const {
    return wide_ ? static_cast<double>(at<std::int64_t>(fields().offset)) : real(fields().offset);
  }
  bool swapped() const { return swapped_; }
  bool is_nifti() const { return wide_ || magic() == "n+1" || magic() == "ni1"; }
  bool is_single() const { return magic() == "n+1" || magic() == "n+2"; }

 private:
  template <class T>
  T at(std::size_t offset) const {
    std::array<unsigned char, sizeof(T)> raw;
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset), sizeof(T), raw.begin());
    if (swapped_) std::reverse(raw.begin(), raw.end());
    T value;
    std::memcpy(&value, raw.data(), sizeof(T));
    return value;
  }
  std::string magic() const { return {reinterpret_cast<const char*>(bytes_.data()) + fields().magic, 3}; }

  std::array<unsigned char, kHeaderBytesNifti2> bytes_{};
  bool swapped_ = false;
  bool wide_ = false;
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
    const std::size_t first = 4 * static_cast<std::size_t>(row);
    for (std::size_t k = 0; k < 3; ++k) affine.columns[k][row] = raw.real(raw.fields().s_rows, first + k);
    affine.origin[row] = raw.real(raw.fields().s_rows, first + 3);
  }
  return affine;
}

// The frame by method 2: a quaternion (a, b, c, d) of which a ≥ 0 is left out, spacing, and a mirror along k.
Affine qform(const RawHeader& raw, const Vec& spacing) {
  const Layout& fields = raw.fields();
  double b = raw.real(fields.quaternion, 0);
  double c = raw.real(fields.quaternion, 1);
  double d = raw.real(fields.quaternion, 2);
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
  const double mirror = raw.real(fields.pixdim) < 0 ? -1 : 1;
  return {{spacing.x * Vec{a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)},
           spacing.y * Vec{2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b)},
           mirror * spacing.z * Vec{2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - b * b - c * c}},
          {raw.real(fields.q_offset, 0), raw.real(fields.q_offset, 1), raw.real(fields.q_offset, 2)}};
}

// The frame, LPS, in the header's units.
Affine affine_of(const RawHeader& raw, bool analyze) {
  Vec spacing;
  for (int axis = 0; axis < 3; ++axis) {
    const double step = std::abs(raw.real(raw.fields().pixdim, static_cast<std::size_t>(axis) + 1));
    spacing[axis] = step > 0 ? step : 1;  // as the reference library does
  }
  const bool has_qform = !analyze && raw.code(raw.fields().qform) > 0;
  const bool has_sform = !analyze && raw.code(raw.fields().sform) > 0;
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

// dim[4] counts times, dim[5] the values of a vector, each of which is a volume of its own, behind the one before.
void set_size(const RawHeader& raw, const std::string& path, ImageHeader& header) {
  const std::int64_t axes = raw.dim(0);
  if (axes < 1 || axes > 7) throw corrupt_file(path, "the header states " + std::to_string(axes) + " axes");
  for (std::size_t axis = 1; axis <= static_cast<std::size_t>(axes); ++axis) {
    const std::int64_t size = raw.dim(axis);
    if (size < 1 || size > std::numeric_limits<std::int32_t>::max()) {
      throw corrupt_file(path, "the header states an axis of " + std::to_string(size) + " voxels");
    }
    header.size.push_back(size);
  }
  if (header.size.size() > 4 && header.size[3] == 1) header.size.erase(header.size.begin() + 3);
}

/// A slope of 0 means that the values are as stored (nifti1.h, "DATA SCALING").
void set_scale(const RawHeader& raw, NiftiHeader& header) {
  header.slope = raw.real(raw.fields().slope);
  header.intercept = raw.real(raw.fields().intercept);
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
  if (!analyze && raw.code(raw.fields().intent) == kLabelIntent)
    image.of_labels = "its NIfTI intent is 1002, NIFTI_INTENT_LABEL";
  set_type(raw.datatype(), image);
  set_size(raw, path, image);
  const Affine affine = affine_of(raw, analyze);
  const double unit = analyze ? 1 : unit_mm(raw.units());
  for (int axis = 0; axis < 3; ++axis) image.columns[axis] = unit * affine.columns[axis];
  image.origin = unit * affine.origin;
}

}  // namespace

NiftiHeader read_nifti_header(const std::string& path) {
  const std::string header_file = partner(path, ".img", ".hdr");
  RawHeader raw;
  if (!raw.load(header_file)) throw corrupt_file(path, "no header");
  const bool analyze = !raw.is_nifti();
  const bool pair = !raw.is_single();
  NiftiHeader header;
  header.voxel_file = pair ? partner(header_file, ".hdr", ".img") : header_file;
  if (header.voxel_file.empty()) throw corrupt_file(path, "the .img file beside it is missing");
  check_regular_file(header.voxel_file);
  constexpr double kFarthest = 1e9;
  const double offset = raw.offset();
  const bool is_near = offset >= 0 && offset < kFarthest;
  header.offset =
      std::max<std::int64_t>(is_near ? static_cast<std::int64_t>(offset) : 0, pair ? 0 : raw.least_offset());
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
  return raw.is_nifti() || ends_with(header_file, ".hdr") || ends_with(header_file, ".hdr.gz");
}

}  // namespace scantet
