// NIfTI and Analyze 7.5 without ITK. Its reader (5.2) is not up to a scan that must be right: a sheared sform is
// refused or replaced by the qform, origins ignore the units, a compressed file that ends early is filled up with
// zeros, an infinite sform aborts the process, and it holds the voxels twice. zlib reads plain files as they are, so
// one path serves .nii and .nii.gz; reading on past the last voxel makes it check its checksum.
#include <zlib.h>

#include <algorithm>
#include <array>
#include <type_traits>

#include "scantet/reading/nifti_header_impl.h"

namespace scantet {
namespace {

constexpr std::int64_t kChunkBytes = 1 << 22;

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
  explicit NiftiImage(const std::string& path) : path_(path), header_(read_nifti_header(path)) {}

  const ImageHeader& header() const override { return header_.image; }

  bool read(void* voxels, Progress& progress) override {
    const GzPointer file(gzopen(header_.voxel_file.c_str(), "rb"));
    if (!file) throw corrupt_file(path_, "'" + header_.voxel_file + "' cannot be opened");
    constexpr unsigned kBuffer = 1 << 18;
    gzbuffer(file.get(), kBuffer);
    if (gzseek(file.get(), static_cast<z_off_t>(header_.offset), SEEK_SET) != header_.offset) fail(*file, 0, 0);
    std::int64_t count = 1;
    for (const std::int64_t n : header_.image.size) count *= n;
    const std::int64_t chunk = kChunkBytes / voxel_bytes(header_.stored);
    std::vector<unsigned char> raw(header_.scaled ? kChunkBytes : 0);
    for (std::int64_t done = 0; done < count; done += chunk) {
      if (progress.cancelled()) return false;
      progress.report({"read", "voxels", static_cast<std::uint64_t>(done), static_cast<std::uint64_t>(count), 0});
      const std::int64_t now = std::min(chunk, count - done);
      unsigned char* place = static_cast<unsigned char*>(voxels) + done * voxel_bytes(*header_.image.type);
      unsigned char* into = header_.scaled ? raw.data() : place;
      const auto bytes = static_cast<unsigned>(now * voxel_bytes(header_.stored));
      const int got = gzread(file.get(), into, bytes);
      if (got != static_cast<int>(bytes)) fail(*file, done * voxel_bytes(header_.stored) + std::max(got, 0), count);
      if (header_.swapped) swap_bytes(into, now);
      if (header_.scaled) scale(into, now, place);
    }
    unsigned char beyond = 0;
    if (gzread(file.get(), &beyond, 1) < 0) fail(*file, count * voxel_bytes(header_.stored), count);
    return true;
  }

 private:
  void swap_bytes(unsigned char* values, std::int64_t count) const {
    with_values(header_.stored, values, [count](auto* v) {
      constexpr std::size_t kBytes = sizeof(*v);
      for (std::int64_t i = 0; i < count; ++i) {
        auto* raw = reinterpret_cast<unsigned char*>(v + i);
        std::reverse(raw, raw + kBytes);
      }
    });
  }

  void scale(unsigned char* from, std::int64_t count, unsigned char* to) const {
    with_values(header_.stored, from, [&](const auto* values) {
      const auto rule = [this](auto v) { return header_.slope * static_cast<double>(v) + header_.intercept; };
      if (*header_.image.type == VoxelType::float32) {
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
                                  std::to_string(count * voxel_bytes(header_.stored)) +
                                  (code < 0 ? ", " + reason : ""));
  }

  std::string path_;
  NiftiHeader header_;
};

}  // namespace

std::string gzip_problem(const std::string& path) {
  std::array<unsigned char, kNiftiHeaderBytes> start{};
  const GzPointer file(gzopen(path.c_str(), "rb"));
  int code = 0;
  if (!file || gzread(file.get(), start.data(), start.size()) == kNiftiHeaderBytes) return {};
  const std::string reason = gzerror(file.get(), &code);
  return code < 0 ? reason : "";
}

std::unique_ptr<ImageSource> open_nifti_image(const std::string& path) {
  return std::make_unique<NiftiImage>(path);
}

}  // namespace scantet
