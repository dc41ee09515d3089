// Small scans for the reader's tests: a temporary folder, writers that owe nothing to the reader, and comparisons.
// reason: one table of file makers for every format, used by four test programs; splitting it would scatter the
// formats.
#pragma once

#include <gtest/gtest.h>
#include <itkImageIOBase.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "scantet/base/error.h"
#include "scantet/reading/scan_reader.h"

namespace scantet::test {

/// A folder of its own for each test, gone afterwards.
class TempFolder {
 public:
  TempFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "scantet_scan_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~TempFolder() { std::filesystem::remove_all(path_); }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// Size and frame of a test scan.
struct Grid {
  std::array<int, 3> size{7, 6, 5};
  std::array<Vec, 3> columns{Vec{0.5, 0, 0}, Vec{0, 0.75, 0}, Vec{0, 0, 2}};
  Point origin{-12.5, 30.25, 7};
  std::size_t count() const { return std::size_t(size[0]) * size[1] * size[2]; }
};

/// Rotated about two axes and left-handed: oblique and flipped, not sheared.
inline Grid oblique_grid() {
  const double c = std::cos(0.3);
  const double s = std::sin(0.3);
  Grid grid;
  grid.columns = {0.5 * Vec{c, s, 0}, 0.75 * Vec{-s * c, c * c, s}, -2.0 * Vec{s * s, -s * c, c}};
  return grid;
}

inline Grid sheared_grid() {
  Grid grid = oblique_grid();
  grid.columns[1] = grid.columns[1] + 0.4 * grid.columns[0];
  grid.columns[2] = grid.columns[2] + 0.7 * grid.columns[0] + -0.3 * grid.columns[1];
  return grid;
}

/// A value for each voxel; no symmetry, so that a swapped or mirrored axis shows. Spans much of the type's range.
template <class T>
std::vector<T> pattern(const Grid& grid) {
  std::vector<T> values;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const int v = (3 * i + 23 * j + 41 * k) % 127;
        if constexpr (std::is_floating_point_v<T>) {
          values.push_back(static_cast<T>(v) * T(-0.37) + T(11));
        } else {
          values.push_back(static_cast<T>(static_cast<T>(v) * (std::numeric_limits<T>::max() / 127)));
        }
      }
    }
  }
  return values;
}

template <class T>
itk::IOComponentEnum component_of() {
  return itk::ImageIOBase::MapPixelType<T>::CType;
}

/// Writes through one of ITK's ImageIO classes. components: values per voxel. dimensions: axes to state, extra ones of
/// size `volumes`.
template <class T>
void write_with(itk::ImageIOBase* io, const std::string& path, const Grid& grid, const std::vector<T>& values,
                unsigned components = 1, unsigned dimensions = 3, unsigned volumes = 1) {
  io->SetFileName(path);
  io->SetNumberOfDimensions(dimensions);
  itk::ImageIORegion region(dimensions);
  for (unsigned axis = 0; axis < dimensions; ++axis) {
    std::vector<double> direction(dimensions, 0.0);
    double spacing = 1;
    if (axis < 3) {
      spacing = length(grid.columns[axis]);
      for (unsigned row = 0; row < std::min(dimensions, 3U); ++row) {
        direction[row] = grid.columns[axis][static_cast<int>(row)] / spacing;
      }
    } else {
      direction[axis] = 1;
    }
    const unsigned size = axis < 3 ? static_cast<unsigned>(grid.size[axis]) : volumes;
    io->SetDimensions(axis, size);
    region.SetSize(axis, size);
    io->SetSpacing(axis, spacing);
    io->SetOrigin(axis, axis < 3 ? grid.origin[static_cast<int>(axis)] : 0);
    io->SetDirection(axis, direction);
  }
  io->SetIORegion(region);
  io->SetComponentType(component_of<T>());
  io->SetNumberOfComponents(components);
  io->SetPixelType(components == 1   ? itk::IOPixelEnum::SCALAR
                   : components == 3 ? itk::IOPixelEnum::RGB
                                     : itk::IOPixelEnum::VECTOR);
  io->WriteImageInformation();
  io->Write(values.data());
}

inline void write_bytes(const std::string& path, const void* bytes, std::size_t count) {
  std::ofstream(path, std::ios::binary).write(static_cast<const char*>(bytes), static_cast<std::streamsize>(count));
}

inline void write_text(const std::string& path, const std::string& text) {
  write_bytes(path, text.data(), text.size());
}

template <class T>
void append_values(const std::string& path, const std::vector<T>& values) {
  std::ofstream(path, std::ios::binary | std::ios::app)
      .write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
}

inline std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

template <class T>
void expect_voxels(const Scan& scan, const std::vector<T>& expected) {
  ASSERT_EQ(scan.voxel_count(), static_cast<std::int64_t>(expected.size()));
  const auto* voxels = std::get_if<const T*>(&scan.voxels);
  ASSERT_NE(voxels, nullptr) << "pixel type is " << scan.pixel_type;
  EXPECT_EQ(std::vector<T>(*voxels, *voxels + expected.size()), expected);
  EXPECT_EQ(scan.min_value, static_cast<double>(*std::min_element(expected.begin(), expected.end())));
  EXPECT_EQ(scan.max_value, static_cast<double>(*std::max_element(expected.begin(), expected.end())));
}

/// Headers hold floats: 1e-6 of the lengths involved.
inline void expect_frame(const Scan& scan, const Grid& grid, double tolerance = 1e-6) {
  EXPECT_EQ(scan.size, grid.size);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LE(distance(scan.frame.column(axis), grid.columns[axis]), tolerance * length(grid.columns[axis]))
        << "column " << axis;
  }
  EXPECT_LE(distance(scan.frame.origin(), grid.origin), tolerance * (1 + length(grid.origin)));
}

inline Scan read(const std::string& path) {
  Progress progress;
  return read_scan(path, progress);
}

/// The file is refused as an input fault with this code, and the message names the file and a remedy. Returns the
/// message.
inline std::string expect_refused(const std::string& path, const std::string& code) {
  try {
    read(path);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    EXPECT_EQ(error.fault(), Fault::input);
    EXPECT_FALSE(error.remedy().empty()) << error.what();
    const std::string message = error.what();
    const std::string name = std::filesystem::path(path).filename().string();
    EXPECT_NE(message.find(name), std::string::npos) << message << " does not name " << name;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  ADD_FAILURE() << path << " was read; expected " << code;
  return {};
}

/// The fields of a NIfTI-1 header that matter here.
struct NiftiFields {
  std::int16_t datatype = 16;  // float
  std::int16_t bits = 32;
  std::array<std::int16_t, 8> dim{3, 7, 6, 5, 1, 1, 1, 1};
  std::array<float, 8> pixdim{1, 1, 1, 1, 1, 1, 1, 1};
  float slope = 0;
  float intercept = 0;
  std::uint8_t units = 2;  // mm
  std::int16_t qform_code = 0;
  std::int16_t sform_code = 0;
  std::array<float, 6> quaternion{};  // b, c, d, then the offset
  std::array<float, 12> srow{};       // RAS, row by row
  std::int16_t intent = 0;
  std::string magic = "n+1";
};

/// The sform of a frame: RAS, so x and y change sign.
inline std::array<float, 12> srow_of(const Grid& grid) {
  std::array<float, 12> srow{};
  for (int row = 0; row < 3; ++row) {
    const double sign = row < 2 ? -1 : 1;
    for (int axis = 0; axis < 3; ++axis) srow[4 * row + axis] = static_cast<float>(sign * grid.columns[axis][row]);
    srow[4 * row + 3] = static_cast<float>(sign * grid.origin[row]);
  }
  return srow;
}

/// 352 bytes of header, or 544 of NIfTI-2 if the magic says so, in the other byte order if `swap`.
inline std::string nifti_header(const NiftiFields& fields, bool swap = false) {
  std::string bytes(352, '\0');
  const auto put = [&](std::size_t offset, auto value) {
    std::array<char, sizeof(value)> raw;
    std::memcpy(raw.data(), &value, sizeof(value));
    if (swap) std::reverse(raw.begin(), raw.end());
    bytes.replace(offset, raw.size(), raw.data(), raw.size());
  };
  if (fields.magic == "n+2") {
    bytes.resize(544);
    put(0, std::int32_t{540});
    bytes.replace(4, 8, std::string("n+2\0\r\n\032\n", 8));
    put(12, fields.datatype);
    put(14, fields.bits);
    for (std::size_t k = 0; k < 8; ++k) put(16 + 8 * k, std::int64_t{fields.dim[k]});
    for (std::size_t k = 0; k < 8; ++k) put(104 + 8 * k, double{fields.pixdim[k]});
    put(168, std::int64_t{544});
    put(176, double{fields.slope});
    put(184, double{fields.intercept});
    put(344, std::int32_t{fields.qform_code});
    put(348, std::int32_t{fields.sform_code});
    for (std::size_t k = 0; k < 6; ++k) put(352 + 8 * k, double{fields.quaternion[k]});
    for (std::size_t k = 0; k < 12; ++k) put(400 + 8 * k, double{fields.srow[k]});
    put(500, std::int32_t{fields.units});
    put(504, std::int32_t{fields.intent});
    return bytes;
  }
  put(0, std::int32_t{348});
  for (std::size_t k = 0; k < 8; ++k) put(40 + 2 * k, fields.dim[k]);
  put(68, fields.intent);
  put(70, fields.datatype);
  put(72, fields.bits);
  for (std::size_t k = 0; k < 8; ++k) put(76 + 4 * k, fields.pixdim[k]);
  put(108, fields.magic == "n+1" ? 352.0F : 0.0F);
  put(112, fields.slope);
  put(116, fields.intercept);
  put(123, fields.units);
  put(252, fields.qform_code);
  put(254, fields.sform_code);
  for (std::size_t k = 0; k < 6; ++k) put(256 + 4 * k, fields.quaternion[k]);
  for (std::size_t k = 0; k < 12; ++k) put(280 + 4 * k, fields.srow[k]);
  bytes.replace(344, 3, fields.magic);
  return bytes;
}

template <class T>
void write_nifti(const std::string& path, const NiftiFields& fields, std::vector<T> values, bool swap = false) {
  write_text(path, nifti_header(fields, swap));
  if (swap) {
    for (T& value : values) {
      auto* raw = reinterpret_cast<char*>(&value);
      std::reverse(raw, raw + sizeof(T));
    }
  }
  append_values(path, values);
}

}  // namespace scantet::test
