// Everything that read_scan must refuse: with which code, naming what, and without a word from the libraries.
#include <itkGiplImageIO.h>
#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>
#include <itkVTKImageIO.h>
#include <sys/stat.h>
#include <unistd.h>

#include <limits>

#include "scan_files.h"

// Read by the leak sanitizer, if there is one: these libraries leak when they fail to read a file.
extern "C" const char* __lsan_default_suppressions();   // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "leak:libITKNrrdIO\nleak:libITKMetaIO\nleak:libITKniftiio\n";
}

namespace scantet {
namespace {

using namespace test;

bool mentions(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

TEST(ScanRefusals, NothingThere) {
  const TempFolder folder;
  expect_refused(folder / "none.nii", "input.not_found");
  expect_refused(folder.path() + "/none/1.2.3", "input.not_found");
  EXPECT_EQ(can_read_scan(folder / "none.nii"), 20);
  EXPECT_EQ(can_read_scan(folder / "none.obj"), 0);
}

TEST(ScanRefusals, EmptyFile) {
  const TempFolder folder;
  for (const char* name : {"a.nrrd", "a.nii", "a.nii.gz", "a.mha", "a.tif", "a.dcm"}) {
    write_text(folder / name, "");
    expect_refused(folder / name, "input.empty");
  }
}

TEST(ScanRefusals, UnknownFormat) {
  const TempFolder folder;
  for (const char* name : {"a.txt", "a.nrrd", "a.nii", "a.nii.gz", "a.mha", "a.vtk", "a.gipl", "a.dcm"}) {
    write_text(folder / name, "This is no image, and long enough to hold many a header. " + std::string(2000, 'x'));
    EXPECT_TRUE(mentions(expect_refused(folder / name, "input.format"), "NRRD")) << name;
    EXPECT_LT(can_read_scan(folder / name), 100);
  }
  write_text(folder / "mesh.vtk",
             "# vtk DataFile Version 2.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 1 float\n0 0 0\n");
  expect_refused(folder / "mesh.vtk", "input.format");
  EXPECT_LT(can_read_scan(folder / "mesh.vtk"), 100);
}

TEST(ScanRefusals, DamagedNifti2) {
  const TempFolder folder;
  NiftiFields fields;
  fields.magic = "n+2";
  const std::string header = nifti_header(fields);
  const auto refused = [&](std::size_t offset, std::int64_t value, const std::string& code) {
    std::string bytes = header;
    bytes.replace(offset, 8, reinterpret_cast<const char*>(&value), 8);
    write_text(folder / "a.nii", bytes + std::string(840, '\1'));
    expect_refused(folder / "a.nii", code);
  };
  refused(16, 9, "input.corrupt");   // axes
  refused(24, -7, "input.corrupt");  // a size
  refused(24, std::int64_t{1} << 40, "input.corrupt");
  refused(24, (std::int64_t{1} << 31) - 1, "input.too_large");
  refused(168, std::int64_t{1} << 29, "input.corrupt");  // where the voxels are
  write_text(folder / "cut.nii", header.substr(0, 400));
  expect_refused(folder / "cut.nii", "input.format");
}

TEST(ScanRefusals, UnreadableFile) {
  if (geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const TempFolder folder;
  write_text(folder / "a.nrrd", "NRRD0004\n");
  ASSERT_EQ(chmod((folder / "a.nrrd").c_str(), 0), 0);
  expect_refused(folder / "a.nrrd", "input.not_found");
}

TEST(ScanRefusals, FlatImages) {
  const TempFolder folder;
  Grid grid;
  write_with(itk::NrrdImageIO::New(), folder / "two.nrrd", grid, pattern<float>(grid), 1, 2);
  EXPECT_TRUE(mentions(expect_refused(folder / "two.nrrd", "input.dimension"), "7 x 6"));
  for (int axis = 0; axis < 3; ++axis) {
    grid = {};
    grid.size[axis] = 1;
    write_with(itk::NrrdImageIO::New(), folder / "thin.nrrd", grid, pattern<float>(grid));
    EXPECT_TRUE(mentions(expect_refused(folder / "thin.nrrd", "input.dimension"), "axis " + std::to_string(axis + 1)));
  }
  write_text(folder / "a.png", "\x89PNG\r\n\x1a\n and more");
  expect_refused(folder / "a.png", "input.dimension");
}

TEST(ScanRefusals, SeveralVolumes) {
  const TempFolder folder;
  const Grid grid;
  std::vector<float> values = pattern<float>(grid);
  for (int more = 0; more < 2; ++more)
    values.insert(values.end(), values.begin(), values.begin() + std::ptrdiff_t(grid.count()));
  write_with(itk::NrrdImageIO::New(), folder / "a.nrrd", grid, values, 1, 4, 3);
  write_with(itk::MetaImageIO::New(), folder / "a.mha", grid, values, 1, 4, 3);
  NiftiFields fields;
  fields.dim = {4, 7, 6, 5, 3, 1, 1, 1};
  write_nifti(folder / "a.nii", fields, values);
  for (const char* name : {"a.nrrd", "a.mha", "a.nii"}) {
    EXPECT_TRUE(mentions(expect_refused(folder / name, "input.dimension"), "3 volumes")) << name;
  }
}

TEST(ScanRefusals, SeveralValuesPerVoxel) {
  const TempFolder folder;
  const Grid grid;
  for (const unsigned components : {2U, 3U, 6U}) {
    const std::vector<std::uint8_t> values(components * grid.count(), 9);
    write_with(itk::NrrdImageIO::New(), folder / "a.nrrd", grid, values, components);
    write_with(itk::MetaImageIO::New(), folder / "a.mha", grid, values, components);
    for (const char* name : {"a.nrrd", "a.mha"}) {
      const std::string message = expect_refused(folder / name, "input.pixel_type");
      EXPECT_TRUE(mentions(message, std::to_string(components) + " values")) << message;
      EXPECT_TRUE(mentions(message, "channel")) << message;
    }
  }
  NiftiFields fields;
  fields.datatype = 32;  // complex
  fields.bits = 64;
  write_nifti(folder / "a.nii", fields, std::vector<float>(2 * grid.count(), 1.0F));
  EXPECT_TRUE(mentions(expect_refused(folder / "a.nii", "input.pixel_type"), "complex"));
  fields.datatype = 128;  // RGB
  fields.bits = 24;
  write_nifti(folder / "b.nii", fields, std::vector<std::uint8_t>(3 * grid.count(), 1));
  expect_refused(folder / "b.nii", "input.pixel_type");
  fields.datatype = 1536;  // 128-bit float
  fields.bits = 128;
  write_nifti(folder / "c.nii", fields, std::vector<double>(2 * grid.count(), 1));
  expect_refused(folder / "c.nii", "input.pixel_type");
}

TEST(ScanRefusals, NanAndInfinity) {
  const TempFolder folder;
  const Grid grid;
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()}) {
    auto floats = pattern<float>(grid);
    auto doubles = pattern<double>(grid);
    for (const std::size_t at : {std::size_t(2 + 7 * (3 + 6 * 1)), grid.count() - 1}) {
      floats[at] = static_cast<float>(bad);
      doubles[at] = bad;
    }
    write_with(itk::NrrdImageIO::New(), folder / "f.nrrd", grid, floats);
    write_with(itk::NrrdImageIO::New(), folder / "d.nrrd", grid, doubles);
    for (const char* name : {"f.nrrd", "d.nrrd"}) {
      const std::string message = expect_refused(folder / name, "input.nan");
      EXPECT_TRUE(mentions(message, "2 voxels")) << message;
      EXPECT_TRUE(mentions(message, "(2, 3, 1)")) << message;
    }
  }
}

TEST(ScanRefusals, ValuesWhoseDifferencesAreNoNumbers) {
  const TempFolder folder;
  const Grid grid;
  std::vector<double> values(grid.count(), -1.7e308);
  values[values.size() / 2] = 1.7e308;
  NiftiFields fields;
  fields.datatype = 64;
  fields.bits = 64;
  write_nifti(folder / "a.nii", fields, values);
  EXPECT_TRUE(mentions(expect_refused(folder / "a.nii", "input.range"), "1e100"));
}

TEST(ScanRefusals, ConstantImage) {
  const TempFolder folder;
  const Grid grid;
  write_with(itk::NrrdImageIO::New(), folder / "a.nrrd", grid, std::vector<std::int8_t>(grid.count(), -3));
  EXPECT_TRUE(mentions(expect_refused(folder / "a.nrrd", "input.constant"), "value -3"));
}

TEST(ScanRefusals, FrameThatDoesNotSpanSpace) {
  const TempFolder folder;
  NiftiFields fields;
  fields.sform_code = 1;
  Grid flat;
  flat.columns[2] = flat.columns[0] + flat.columns[1];
  fields.srow = srow_of(flat);
  write_nifti(folder / "a.nii", fields, pattern<float>(flat));
  expect_refused(folder / "a.nii", "input.frame");
  fields.srow.fill(0);
  write_nifti(folder / "b.nii", fields, pattern<float>(flat));
  expect_refused(folder / "b.nii", "input.frame");
  fields.srow[0] = std::numeric_limits<float>::quiet_NaN();
  write_nifti(folder / "c.nii", fields, pattern<float>(flat));
  expect_refused(folder / "c.nii", "input.frame");
}

TEST(ScanRefusals, HeadersThatAskForTooMuch) {
  const TempFolder folder;
  const std::string sizes = "100000 100000 100000";
  write_text(folder / "a.nrrd",
             "NRRD0004\ntype: float\ndimension: 3\nsizes: " + sizes + "\nendian: little\nencoding: raw\n\nfew bytes");
  write_text(folder / "b.mha", "ObjectType = Image\nNDims = 3\nDimSize = " + sizes +
                                   "\nElementType = MET_FLOAT\nElementDataFile = LOCAL\nfew bytes");
  write_text(folder / "c.vtk", "# vtk DataFile Version 3.0\nx\nBINARY\nDATASET STRUCTURED_POINTS\nDIMENSIONS " + sizes +
                                   "\nSPACING 1 1 1\nORIGIN 0 0 0\nPOINT_DATA 1000000000000000\nSCALARS s float 1\n"
                                   "LOOKUP_TABLE default\nfew bytes");
  NiftiFields fields;
  fields.dim = {3, 32767, 32767, 32767, 1, 1, 1, 1};
  write_nifti(folder / "d.nii", fields, std::vector<float>(10, 1.0F));
  for (const char* name : {"a.nrrd", "b.mha", "c.vtk", "d.nii"}) {
    const std::string message = expect_refused(folder / name, "input.too_large");
    EXPECT_TRUE(mentions(message, "GB")) << message;
  }
  for (const char* axis : {"5000000000", "4294967297", "1e30"}) {
    write_text(folder / "e.nrrd", std::string("NRRD0004\ntype: float\ndimension: 3\nsizes: 2 2 ") + axis +
                                      "\nencoding: raw\nendian: little\n\nfew");
    write_text(folder / "e.mha", std::string("ObjectType = Image\nNDims = 3\nDimSize = 2 2 ") + axis +
                                     "\nElementType = MET_FLOAT\nElementDataFile = LOCAL\nfew");
    expect_refused(folder / "e.nrrd", "input.too_large");
    expect_refused(folder / "e.mha", "input.too_large");
  }
  write_text(folder / "f.mha",
             "ObjectType = Image\nNDims = 300\nDimSize = 2 2 2\nElementType = MET_FLOAT\n"
             "ElementDataFile = LOCAL\nfew");
  expect_refused(folder / "f.mha", "input.dimension");
  write_text(folder / "g.nrrd", "NRRD0004\ntype: float\ndimension: 3\nsizes: 2 -4 2\nencoding: raw\n\nfew");
  expect_refused(folder / "g.nrrd", "input.corrupt");
}

TEST(ScanRefusals, MissingDetachedData) {
  const TempFolder folder;
  write_with(itk::NrrdImageIO::New(), folder / "a.nhdr", Grid{}, pattern<float>(Grid{}));
  write_with(itk::MetaImageIO::New(), folder / "b.mhd", Grid{}, pattern<float>(Grid{}));
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    const std::string extension = entry.path().extension();
    if (extension != ".nhdr" && extension != ".mhd") std::filesystem::remove(entry.path());
  }
  expect_refused(folder / "a.nhdr", "input.corrupt");
  expect_refused(folder / "b.mhd", "input.corrupt");
}

TEST(ScanRefusals, DamagedCompressedVoxels) {
  const TempFolder folder;
  write_with(itk::NiftiImageIO::New(), folder / "a.nii.gz", Grid{}, pattern<std::int16_t>(Grid{}));
  const std::string whole = bytes_of(folder / "a.nii.gz");
  for (std::size_t at = whole.size() / 2; at < whole.size(); at += 7) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    write_text(folder / "a.nii.gz", damaged);
    expect_refused(folder / "a.nii.gz", "input.corrupt");
  }
}

// A file that ends early is never read as if it were whole, and no library prints about it.
TEST(ScanRefusals, FilesThatEndEarly) {
  const TempFolder folder;
  const Grid grid;
  const auto values = pattern<std::int16_t>(grid);
  const auto packed_nrrd = itk::NrrdImageIO::New();
  packed_nrrd->SetUseCompression(true);
  const auto packed_meta = itk::MetaImageIO::New();
  packed_meta->SetUseCompression(true);
  const auto text = itk::VTKImageIO::New();
  text->SetFileTypeToASCII();
  const auto binary = itk::VTKImageIO::New();
  binary->SetFileTypeToBinary();
  write_with(itk::NrrdImageIO::New(), folder / "raw.nrrd", grid, values);
  write_with(packed_nrrd, folder / "packed.nrrd", grid, values);
  write_with(itk::MetaImageIO::New(), folder / "raw.mha", grid, values);
  write_with(packed_meta, folder / "packed.mha", grid, values);
  write_with(itk::NiftiImageIO::New(), folder / "raw.nii", grid, values);
  write_with(itk::NiftiImageIO::New(), folder / "packed.nii.gz", grid, values);
  write_with(text, folder / "text.vtk", grid, values);
  write_with(binary, folder / "binary.vtk", grid, values);
  write_with(itk::GiplImageIO::New(), folder / "raw.gipl", grid, values);
  const std::vector<std::filesystem::path> files{std::filesystem::directory_iterator(folder.path()), {}};
  ASSERT_EQ(files.size(), 9U);
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  std::string read_all_the_same;
  for (const std::filesystem::path& file : files) {
    const std::string whole = bytes_of(file);
    const std::string cut = folder / ("cut_" + file.filename().string());
    for (int part = 1; part < 40; ++part) {
      write_text(cut, whole.substr(0, whole.size() * static_cast<std::size_t>(part) / 40));
      try {
        read(cut);
        read_all_the_same += cut + " at " + std::to_string(part) + "/40\n";
      } catch (const Error& error) {
        if (error.fault() != Fault::input) read_all_the_same += error.what();
      }
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(read_all_the_same, "");
}

}  // namespace
}  // namespace scantet
