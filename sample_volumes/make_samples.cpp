// Makes the sample scans, checks that a folder holds them, and prints the tables of what is known of them.
//
// ITK's ImageIO classes are used directly: they take the pixel type as a value and the pixels as bytes, which is all
// that is needed here.
#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "sample.h"

namespace {

using samples::Pixel;
using samples::Sample;

// Relative; the last refinement of the quadrature may not change a volume of the table by more.
constexpr double kVolumeError = 1e-4;

template <class Value>
std::vector<char> packed(const std::vector<double>& voxels) {
  std::vector<char> bytes(voxels.size() * sizeof(Value));
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    const auto value = static_cast<Value>(voxels[i]);
    if (static_cast<double>(value) != voxels[i]) throw std::logic_error("a voxel does not fit its pixel type");
    std::memcpy(&bytes[i * sizeof(Value)], &value, sizeof(Value));
  }
  return bytes;
}

std::pair<itk::IOComponentEnum, std::vector<char>> encoded(const Sample& sample) {
  switch (sample.pixel) {
    case Pixel::uint8:
      return {itk::IOComponentEnum::UCHAR, packed<std::uint8_t>(sample.voxels)};
    case Pixel::int8:
      return {itk::IOComponentEnum::CHAR, packed<std::int8_t>(sample.voxels)};
    case Pixel::uint16:
      return {itk::IOComponentEnum::USHORT, packed<std::uint16_t>(sample.voxels)};
    case Pixel::int16:
      return {itk::IOComponentEnum::SHORT, packed<std::int16_t>(sample.voxels)};
    case Pixel::float32:
      break;
  }
  return {itk::IOComponentEnum::FLOAT, packed<float>(sample.voxels)};
}

itk::ImageIOBase::Pointer image_io(const std::string& path) {
  itk::ImageIOBase::Pointer io;
  if (path.ends_with(".nrrd")) {
    io = itk::NrrdImageIO::New();
  } else if (path.ends_with(".mha")) {
    auto meta = itk::MetaImageIO::New();
    meta->SetDoublePrecision(17);
    io = meta;
  } else {
    io = itk::NiftiImageIO::New();
  }
  io->SetFileName(path);
  return io;
}

itk::ImageIORegion whole(const Sample& sample) {
  itk::ImageIORegion region(3);
  for (unsigned axis = 0; axis < 3; ++axis) region.SetSize(axis, sample.grid.size[axis]);
  return region;
}

void write(const Sample& sample, const std::string& path) {
  auto io = image_io(path);
  io->SetNumberOfDimensions(3);
  for (unsigned axis = 0; axis < 3; ++axis) {
    const auto& column = sample.grid.columns[axis];
    const double spacing = std::sqrt(column[0] * column[0] + column[1] * column[1] + column[2] * column[2]);
    io->SetDimensions(axis, sample.grid.size[axis]);
    io->SetSpacing(axis, spacing);
    io->SetOrigin(axis, sample.grid.origin[axis]);
    io->SetDirection(axis, std::vector<double>{column[0] / spacing, column[1] / spacing, column[2] / spacing});
  }
  const auto [component, bytes] = encoded(sample);
  io->SetPixelType(itk::IOPixelEnum::SCALAR);
  io->SetComponentType(component);
  io->SetNumberOfComponents(1);
  io->SetIORegion(whole(sample));
  io->SetUseCompression(true);
  io->WriteImageInformation();
  io->Write(bytes.data());
}

// Throws unless the file holds the sample: same size, pixel type and voxels, and the same frame as far as the format's
// numbers go (NIfTI keeps its frame in single precision).
void check(const Sample& sample, const std::string& path) {
  constexpr double kFrameError = 1e-5;  // mm at the far corner
  auto io = image_io(path);
  io->ReadImageInformation();
  const auto [component, expected] = encoded(sample);
  if (io->GetNumberOfDimensions() != 3 || io->GetComponentType() != component) {
    throw std::runtime_error(path + ": wrong dimension or pixel type");
  }
  samples::Grid grid;
  for (unsigned axis = 0; axis < 3; ++axis) {
    grid.size[axis] = static_cast<int>(io->GetDimensions(axis));
    grid.origin[axis] = io->GetOrigin(axis);
    for (unsigned x = 0; x < 3; ++x) grid.columns[axis][x] = io->GetSpacing(axis) * io->GetDirection(axis)[x];
  }
  if (grid.size != sample.grid.size) throw std::runtime_error(path + ": wrong size");
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1 ? grid.size[0] - 1 : 0;
    const int j = corner & 2 ? grid.size[1] - 1 : 0;
    const int k = corner & 4 ? grid.size[2] - 1 : 0;
    const auto found = grid.to_world(i, j, k);
    const auto wanted = sample.grid.to_world(i, j, k);
    for (int x = 0; x < 3; ++x) {
      if (!(std::abs(found[x] - wanted[x]) <= kFrameError)) throw std::runtime_error(path + ": wrong frame");
    }
  }
  std::vector<char> bytes(expected.size());
  io->SetIORegion(whole(sample));
  io->Read(bytes.data());
  if (bytes != expected) throw std::runtime_error(path + ": wrong voxels");
}

std::string trimmed_number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

// One line per file, in the columns of README.md.
std::vector<std::string> table(const std::vector<Sample>& all) {
  std::vector<std::string> lines = {"| file | level | inside | volume_mm3 | components | cavities | euler | what |",
                                    "| --- | --- | --- | --- | --- | --- | --- | --- |"};
  for (const Sample& sample : all) {
    const auto volume = samples::trilinear_volume(sample);
    if (volume.relative_change > kVolumeError) {
      throw std::logic_error(sample.files[0] + ": the volume has not settled, its last relative change was " +
                             trimmed_number(volume.relative_change));
    }
    std::ostringstream rest;
    rest << " | " << sample.level << " | " << (sample.inside_above ? "above" : "below") << " | ";
    rest.precision(2);
    rest << std::fixed << volume.mm3 << " | " << sample.components << " | " << sample.cavities << " | " << sample.euler
         << " | " << sample.what << " |";
    for (const std::string& file : sample.files) lines.push_back("| " + file + rest.str());
  }
  return lines;
}

// As table(), of the segmentations.
std::vector<std::string> label_table(const std::vector<samples::LabelMap>& maps) {
  std::vector<std::string> lines = {"| segmentation | label | voxels | volume_mm3 | what |",
                                    "| --- | --- | --- | --- | --- |"};
  for (const samples::LabelMap& map : maps) {
    for (const samples::LabelMap::Row& row : map.rows) {
      std::ostringstream line;
      line.precision(0);
      line << "| " << map.scan.files[0] << " | " << row.label << " | " << row.voxels << " | " << std::fixed
           << row.volume_mm3 << " | " << row.what << " |";
      lines.push_back(line.str());
    }
  }
  return lines;
}

void check_tables(const std::vector<std::string>& expected, const std::filesystem::path& readme) {
  std::ifstream in(readme);
  std::vector<std::string> found;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("| ")) found.push_back(line);
  }
  if (found != expected) throw std::runtime_error(readme.string() + ": a table is not that of make_samples --table");
}

int run(const std::vector<std::string>& arguments) {
  auto all = samples::all_samples();
  const auto maps = samples::all_label_maps();
  if (arguments.size() == 1 && arguments[0] == "--table") {
    for (const std::string& line : table(all)) std::cout << line << '\n';
    std::cout << '\n';
    for (const std::string& line : label_table(maps)) std::cout << line << '\n';
    return 0;
  }
  const bool checking = arguments.size() == 2 && arguments[0] == "--check";
  if (!checking && (arguments.size() != 1 || arguments[0].starts_with("-"))) {
    std::cerr << "usage: make_samples FOLDER          write the scans\n"
                 "       make_samples --check FOLDER  are they there, and is README.md right?\n"
                 "       make_samples --table         print its tables\n";
    return 2;
  }
  const std::filesystem::path folder = arguments.back();
  if (!checking) std::filesystem::create_directories(folder);
  std::vector<std::string> lines = checking ? table(all) : std::vector<std::string>();
  for (const std::string& line : label_table(maps)) lines.push_back(line);
  for (const samples::LabelMap& map : maps) all.push_back(map.scan);
  for (const Sample& sample : all) {
    for (const std::string& file : sample.files) {
      const std::string path = (folder / file).string();
      checking ? check(sample, path) : write(sample, path);
    }
  }
  if (checking) check_tables(lines, folder / "README.md");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << "make_samples: " << error.what() << '\n';
    return 1;
  }
}
