// NIfTI-1 and Analyze 7.5 without ITK. Its reader (5.2) is not up to a scan that must be right: a sheared sform is
// refused or replaced by the qform, origins ignore the units, a compressed file that ends early is filled up with
// zeros, an infinite sform aborts the process, and it holds the voxels twice. The format is one 348-byte header and
// plain voxels: fields are taken by their offsets in nifti1.h, swapped if sizeof_hdr says so. zlib reads plain files as
// they are, so one path serves .nii and .nii.gz; reading on past the last voxel makes it check its checksum. Analyze
// has the same layout up to the orientation fields, which are left alone: spacing only.
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <type_traits>

#include "scantet/base/regular_file.h"
#include "scantet/reading/image_source_impl.h"

namespace scantet {
namespace {

constexpr int kHeaderBytes = 348;
constexpr int kHeaderBytesNifti2 = 540;
constexpr std::int64_t kChunkBytes = 1 << 22;

struct CloseGz {
  void operator()(gzFile_s* file) const { gzclose(file); }
};
using GzPointer = std::unique_ptr<gzFile_s, CloseGz>;

class RawHeader {
 public:
  // False if the file is not that long, or no header in either byte order.
  bool load(const std::string& path) {
    check_regular_file(path);
    const GzPointer file(gzopen(path.c_str(), "rb"));
    if (!file || gzread(file.get(), bytes_.data(), kHeaderBytes) != kHeaderBytes) return false;
    swapped_ = at<std::int32_t>(0) != kHeaderBytes;
    return at<std::int32_t>(0) == kHeaderBytes;
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
  std::array<unsigned char, kHeaderBytes> bytes_{};
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

// Method 3.
Affine sform(const RawHeader& raw) {
  Affine affine;
  for (int row = 0; row < 3; ++row) {
    const std::size_t first = 280 + 16 * static_cast<std::size_t>(row);
    for (int k = 0; k < 3; ++k) affine.columns[k][row] = raw.real(first + 4 * static_cast<std::size_t>(k));
    affine.origin[row] = raw.real(first + 12);
  }
  return affine;
}

// Method 2: a quaternion (a, b, c, d) of which a ≥ 0 is left out, spacing, and a mirror along k.
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

// LPS, in the header's units.
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

template <class F>
void with_values(VoxelType type, void* bytes, F&& f) {
  switch (type) {
    case VoxelType::int8:
      return f(static_cast<std::int8_t*>(bytes));
    case VoxelType::uint8:
      return f(static_cast<std::uint8_t*>(bytes));
    case VoxelType::int16:
      return f(static_cast<std::int16_t*>(bytes));
    case VoxelType::uint16:
      return f(static_cast<std::uint16_t*>(bytes));
    case VoxelType::int32:
      return f(static_cast<std::int32_t*>(bytes));
    case VoxelType::uint32:
      return f(static_cast<std::uint32_t*>(bytes));
    case VoxelType::int64:
      return f(static_cast<std::int64_t*>(bytes));
    case VoxelType::uint64:
      return f(static_cast<std::uint64_t*>(bytes));
    case VoxelType::float32:
      return f(static_cast<float*>(bytes));
    case VoxelType::float64:
      return f(static_cast<double*>(bytes));
  }
}

class NiftiImage final : public ImageSource {
 public:
  explicit NiftiImage(const std::string& path) : path_(path) {
    const std::string header_file = partner(path, ".img", ".hdr");
    RawHeader raw;
    if (!raw.load(header_file)) throw corrupt_file(path, "no header");
    const bool analyze = !is_nifti_magic(raw.magic());
    const bool pair = raw.magic() != "n+1";
    voxel_file_ = pair ? partner(header_file, ".hdr", ".img") : header_file;
    if (voxel_file_.empty()) throw corrupt_file(path, "the .img file beside it is missing");
    check_regular_file(voxel_file_);
    constexpr double kFarthest = 1e9;
    const double offset = raw.real(108);
    offset_ = std::max<std::int64_t>(offset < kFarthest ? static_cast<std::int64_t>(offset) : 0, pair ? 0 : 352);
    swapped_ = raw.swapped();

    header_.format = analyze ? "Analyze" : "NIfTI";
    constexpr int kLabelIntent = 1002;
    if (!analyze && raw.whole(68) == kLabelIntent) header_.of_labels = "its NIfTI intent is 1002, NIFTI_INTENT_LABEL";
    set_type(raw.whole(70), header_);
    set_size(raw, path, header_);
    const Affine affine = affine_of(raw, analyze);
    const double unit = analyze ? 1 : unit_mm(raw.at<std::uint8_t>(123));
    for (int axis = 0; axis < 3; ++axis) header_.columns[axis] = unit * affine.columns[axis];
    header_.origin = unit * affine.origin;
    if (header_.type) {
      stored_ = *header_.type;
      if (!analyze) set_scale(raw);
    }
  }

  const ImageHeader& header() const override { return header_; }

  bool read(void* voxels, Progress& progress) override {
    const GzPointer file(gzopen(voxel_file_.c_str(), "rb"));
    if (!file) throw corrupt_file(path_, "'" + voxel_file_ + "' cannot be opened");
    constexpr unsigned kBuffer = 1 << 18;
    gzbuffer(file.get(), kBuffer);
    if (gzseek(file.get(), static_cast<z_off_t>(offset_), SEEK_SET) != offset_) fail(*file, 0, 0);
    std::int64_t count = 1;
    for (const std::int64_t n : header_.size) count *= n;
    const std::int64_t chunk = kChunkBytes / voxel_bytes(stored_);
    std::vector<unsigned char> raw(scaled_ ? kChunkBytes : 0);
    for (std::int64_t done = 0; done < count; done += chunk) {
      if (progress.cancelled()) return false;
      progress.report({"read", "voxels", static_cast<std::uint64_t>(done), static_cast<std::uint64_t>(count), 0});
      const std::int64_t now = std::min(chunk, count - done);
      unsigned char* place = static_cast<unsigned char*>(voxels) + done * voxel_bytes(*header_.type);
      unsigned char* into = scaled_ ? raw.data() : place;
      const auto bytes = static_cast<unsigned>(now * voxel_bytes(stored_));
      const int got = gzread(file.get(), into, bytes);
      if (got != static_cast<int>(bytes)) fail(*file, done * voxel_bytes(stored_) + std::max(got, 0), count);
      if (swapped_) swap_bytes(into, now);
      if (scaled_) scale(into, now, place);
    }
    unsigned char beyond = 0;
    if (gzread(file.get(), &beyond, 1) < 0) fail(*file, count * voxel_bytes(stored_), count);
    return true;
  }

 private:
  // A slope of 0 means that the values are as stored (nifti1.h, "DATA SCALING").
  void set_scale(const RawHeader& raw) {
    slope_ = raw.real(112);
    intercept_ = raw.real(116);
    if (slope_ == 0 || !std::isfinite(slope_) || !std::isfinite(intercept_)) return;
    scaled_ = slope_ != 1 || intercept_ != 0;
    constexpr int kFloatDigits = 16;  // bits of an integer that a float holds for sure, with room for the scale
    const bool wide = 8 * voxel_bytes(stored_) > kFloatDigits && stored_ != VoxelType::float32;
    if (scaled_) header_.type = wide ? VoxelType::float64 : VoxelType::float32;
  }

  void swap_bytes(unsigned char* values, std::int64_t count) const {
    with_values(stored_, values, [count](auto* v) {
      constexpr std::size_t kBytes = sizeof(*v);
      for (std::int64_t i = 0; i < count; ++i) {
        auto* raw = reinterpret_cast<unsigned char*>(v + i);
        std::reverse(raw, raw + kBytes);
      }
    });
  }

  void scale(unsigned char* from, std::int64_t count, unsigned char* to) const {
    with_values(stored_, from, [&](const auto* values) {
      const auto rule = [this](auto v) { return slope_ * static_cast<double>(v) + intercept_; };
      if (*header_.type == VoxelType::float32) {
        std::transform(values, values + count, reinterpret_cast<float*>(to),
                       [&](auto v) { return static_cast<float>(rule(v)); });
      } else {
        std::transform(values, values + count, reinterpret_cast<double*>(to), rule);
      }
    });
  }

  [[noreturn]] void fail(gzFile_s& file, std::int64_t bytes, std::int64_t count) const {
    int code = 0;
    const std::string reason = gzerror(&file, &code);
    throw corrupt_file(path_, std::to_string(bytes) + " bytes of voxels instead of " +
                                  std::to_string(count * voxel_bytes(stored_)) + (code < 0 ? ", " + reason : ""));
  }

  std::string path_;
  std::string voxel_file_;
  std::int64_t offset_ = 0;
  bool swapped_ = false;
  VoxelType stored_ = VoxelType::uint8;
  bool scaled_ = false;
  double slope_ = 1;
  double intercept_ = 0;
  ImageHeader header_;
};

}  // namespace

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

std::string gzip_problem(const std::string& path) {
  std::array<unsigned char, kHeaderBytes> start{};
  const GzPointer file(gzopen(path.c_str(), "rb"));
  int code = 0;
  if (!file || gzread(file.get(), start.data(), start.size()) == kHeaderBytes) return {};
  const std::string reason = gzerror(file.get(), &code);
  return code < 0 ? reason : "";
}

std::unique_ptr<ImageSource> open_nifti_image(const std::string& path) {
  return std::make_unique<NiftiImage>(path);
}

}  // namespace scantet
