// Every format that is written here is read back: voxels bit by bit, frame to what a header can hold.
#include "scantet/reading/scan_reader.h"

#include <itkGiplImageIO.h>
#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>
#include <itkVTKImageIO.h>
#include <zlib.h>

#include "scan_files.h"
#include "scantet/field/scan_statistics.h"
#include "scantet/reading/suggested_level.h"

namespace scantet {
namespace {

using namespace test;

template <class T>
class EveryPixelType : public testing::Test {};

using PixelTypes = testing::Types<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, std::uint32_t,
                                  std::int64_t, std::uint64_t, float, double>;
TYPED_TEST_SUITE(EveryPixelType, PixelTypes);

template <class T>
std::string name_of() {
  if (std::is_same_v<T, float>) return "float";
  if (std::is_same_v<T, double>) return "double";
  return (std::is_signed_v<T> ? "int" : "uint") + std::to_string(8 * sizeof(T));
}

TYPED_TEST(EveryPixelType, SurvivesNrrdMetaImageAndNifti) {
  const TempFolder folder;
  const Grid grid = oblique_grid();
  const std::vector<TypeParam> values = pattern<TypeParam>(grid);
  write_with(itk::NrrdImageIO::New(), folder / "a.nrrd", grid, values);
  write_with(itk::NrrdImageIO::New(), folder / "b.nhdr", grid, values);
  write_with(itk::MetaImageIO::New(), folder / "c.mha", grid, values);
  write_with(itk::MetaImageIO::New(), folder / "d.mhd", grid, values);
  write_with(itk::NiftiImageIO::New(), folder / "e.nii", grid, values);
  write_with(itk::NiftiImageIO::New(), folder / "f.nii.gz", grid, values);
  for (const char* name : {"a.nrrd", "b.nhdr", "c.mha", "d.mhd", "e.nii", "f.nii.gz"}) {
    SCOPED_TRACE(name);
    EXPECT_EQ(can_read_scan(folder / name), 100);
    const Scan scan = read(folder / name);
    expect_voxels(scan, values);
    expect_frame(scan, grid);
    EXPECT_EQ(scan.pixel_type, name_of<TypeParam>());
  }
  EXPECT_EQ(read(folder / "a.nrrd").format, "NRRD");
  EXPECT_EQ(read(folder / "c.mha").format, "MetaImage");
  EXPECT_EQ(read(folder / "e.nii").format, "NIfTI");
}

// Otsu's level of two groups of values lies between them, whatever the type.
TYPED_TEST(EveryPixelType, SuggestedLevelParts) {
  Grid grid;
  std::vector<TypeParam> values = pattern<TypeParam>(grid);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = static_cast<TypeParam>(k % 3 == 0 ? 100 + k % 7 : k % 5);
  const TempFolder folder;
  write_with(itk::NrrdImageIO::New(), folder / "a.nrrd", grid, values);
  EXPECT_NEAR(suggested_level(read(folder / "a.nrrd")), 52, 0.6);
}

TEST(ScanReader, CompressedNrrdAndMetaImage) {
  const TempFolder folder;
  const Grid grid;
  const auto values = pattern<std::int16_t>(grid);
  const auto nrrd = itk::NrrdImageIO::New();
  nrrd->SetUseCompression(true);
  write_with(nrrd, folder / "a.nrrd", grid, values);
  const auto meta = itk::MetaImageIO::New();
  meta->SetUseCompression(true);
  write_with(meta, folder / "a.mha", grid, values);
  expect_voxels(read(folder / "a.nrrd"), values);
  expect_voxels(read(folder / "a.mha"), values);
}

TEST(ScanReader, OtherItkFormats) {
  const TempFolder folder;
  const Grid grid;
  const auto values = pattern<std::int16_t>(grid);
  const auto vtk_text = itk::VTKImageIO::New();
  vtk_text->SetFileTypeToASCII();
  const auto vtk_binary = itk::VTKImageIO::New();
  vtk_binary->SetFileTypeToBinary();
  write_with(vtk_text, folder / "text.vtk", grid, values);
  write_with(vtk_binary, folder / "binary.vtk", grid, values);
  write_with(itk::GiplImageIO::New(), folder / "a.gipl", grid, values);
  for (const char* name : {"text.vtk", "binary.vtk", "a.gipl"}) {
    SCOPED_TRACE(name);
    EXPECT_EQ(can_read_scan(folder / name), 100);
    expect_voxels(read(folder / name), values);
  }
  expect_frame(read(folder / "text.vtk"), grid);
  expect_frame(read(folder / "binary.vtk"), grid);
  expect_frame(read(folder / "a.gipl"), grid);
}

TEST(ScanReader, NrrdSpacesAndShear) {
  const TempFolder folder;
  const Grid grid = sheared_grid();
  const auto values = pattern<float>(grid);
  write_bytes(folder / "voxels.raw", values.data(), values.size() * sizeof(float));
  const auto header = [&](const std::string& space, double x, double y) {
    std::ostringstream text;
    text.precision(17);
    const auto vector = [&](const Vec& v) { text << "(" << x * v.x << "," << y * v.y << "," << v.z << ") "; };
    text << "NRRD0004\ntype: float\ndimension: 3\nspace: " << space << "\nsizes: 7 6 5\nspace directions: ";
    for (const Vec& column : grid.columns) vector(column);
    text << "\nendian: little\nencoding: raw\nspace origin: ";
    vector(grid.origin);
    text << "\ndata file: voxels.raw\n";
    return text.str();
  };
  write_text(folder / "lps.nhdr", header("left-posterior-superior", 1, 1));
  write_text(folder / "ras.nhdr", header("right-anterior-superior", -1, -1));
  write_text(folder / "las.nhdr", header("LAS", 1, -1));
  for (const char* name : {"lps.nhdr", "ras.nhdr", "las.nhdr"}) {
    SCOPED_TRACE(name);
    const Scan scan = read(folder / name);
    expect_voxels(scan, values);
    // ITK 5.2 changes the wrong sign of LAS; the reader must not.
    expect_frame(scan, grid, 1e-12);
    EXPECT_TRUE(orientation_of(scan.frame).sheared);
    EXPECT_TRUE(orientation_of(scan.frame).left_handed);
  }
}

TEST(ScanReader, MetaImageKeepsShear) {
  const TempFolder folder;
  const Grid grid = sheared_grid();
  write_with(itk::MetaImageIO::New(), folder / "a.mha", grid, pattern<float>(grid));
  expect_frame(read(folder / "a.mha"), grid);
}

TEST(NiftiReader, ShearedSformWithoutQform) {
  const TempFolder folder;
  const Grid grid = sheared_grid();
  NiftiFields fields;
  fields.sform_code = 1;
  fields.srow = srow_of(grid);
  write_nifti(folder / "a.nii", fields, pattern<float>(grid));
  const Scan scan = read(folder / "a.nii");
  expect_frame(scan, grid);
  expect_voxels(scan, pattern<float>(grid));
}

TEST(NiftiReader, SformWinsOverADifferentQform) {
  const TempFolder folder;
  for (const Grid& grid : {sheared_grid(), oblique_grid()}) {
    NiftiFields fields;
    fields.sform_code = 4;
    fields.qform_code = 1;
    fields.srow = srow_of(grid);
    write_nifti(folder / "a.nii", fields, pattern<float>(grid));
    expect_frame(read(folder / "a.nii"), grid);
  }
}

// A turn by 2·asin(0.5) = 60° about z, mirrored by qfac = -1: (b, c, d) = (0, 0, 0.5).
TEST(NiftiReader, QformAlone) {
  const TempFolder folder;
  NiftiFields fields;
  fields.qform_code = 1;
  fields.pixdim = {-1, 0.5F, 0.75F, 2, 1, 1, 1, 1};
  fields.quaternion = {0, 0, 0.5F, 10, 20, 30};
  Grid grid;
  const double c = 0.5;
  const double s = std::sqrt(0.75);
  grid.columns = {0.5 * Vec{-c, -s, 0}, 0.75 * Vec{s, -c, 0}, Vec{0, 0, -2}};
  grid.origin = {-10, -20, 30};
  write_nifti(folder / "a.nii", fields, pattern<float>(grid));
  expect_frame(read(folder / "a.nii"), grid);
}

TEST(NiftiReader, Nifti2IsReadInEitherByteOrder) {
  const TempFolder folder;
  const Grid grid = sheared_grid();
  NiftiFields fields;
  fields.magic = "n+2";
  fields.sform_code = 2;
  fields.srow = srow_of(grid);
  fields.intent = 1002;
  for (const bool swap : {false, true}) {
    write_nifti(folder / "a.nii", fields, pattern<float>(grid), swap);
    const Scan scan = read(folder / "a.nii");
    EXPECT_EQ(can_read_scan(folder / "a.nii"), 100);
    expect_frame(scan, grid);
    expect_voxels(scan, pattern<float>(grid));
    EXPECT_NE(scan.header_of_labels.find("1002"), std::string::npos);
  }
  fields.sform_code = 0;
  fields.qform_code = 1;
  fields.pixdim = {-1, 0.5F, 0.75F, 2, 1, 1, 1, 1};
  fields.quaternion = {0, 0, 0.5F, 10, 20, 30};
  fields.datatype = 4;
  fields.bits = 16;
  fields.slope = 2;
  fields.intercept = -1;
  write_nifti(folder / "b.nii", fields, pattern<std::int16_t>(Grid{}));
  fields.magic = "n+1";
  write_nifti(folder / "c.nii", fields, pattern<std::int16_t>(Grid{}));
  const Scan second = read(folder / "b.nii");
  const Scan first = read(folder / "c.nii");
  for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(second.frame.column(axis), first.frame.column(axis));
  EXPECT_EQ(second.frame.origin(), first.frame.origin());
  EXPECT_EQ(second.max_value, first.max_value);
}

TEST(ScanReader, VolumesOfProbabilitiesComeOneByOne) {
  const TempFolder folder;
  const Grid grid;
  std::vector<float> values;  // volume after volume
  std::vector<float> interleaved(3 * grid.count());
  for (std::size_t n = 0; n < 3 * grid.count(); ++n) {
    values.push_back(static_cast<float>(n) / 1000);
    interleaved[n % grid.count() * 3 + n / grid.count()] = values.back();
  }
  NiftiFields fields;
  fields.dim = {4, 7, 6, 5, 3, 1, 1, 1};
  write_nifti(folder / "a.nii", fields, values);
  write_with(itk::NrrdImageIO::New(), folder / "b.nrrd", grid, values, 1, 4, 3);
  write_with(itk::MetaImageIO::New(), folder / "c.mha", grid, values, 1, 4, 3);
  write_text(folder / "d.nrrd",
             "NRRD0004\ntype: float\ndimension: 4\nspace: left-posterior-superior\nsizes: 3 7 6 5\nspace directions: "
             "none (1,0,0) (0,1,0) (0,0,1)\nkinds: list domain domain domain\nendian: little\nencoding: raw\n\n");
  append_values(folder / "d.nrrd", interleaved);
  NiftiFields of_vectors = fields;  // whose components are volumes, too
  of_vectors.dim = {5, 7, 6, 5, 1, 3, 1, 1};
  of_vectors.intent = 1007;
  write_nifti(folder / "e.nii", of_vectors, values);
  for (const char* name : {"a.nii", "b.nrrd", "c.mha", "d.nrrd", "e.nii"}) {
    Progress progress;
    const std::vector<Scan> volumes = read_volumes(folder / name, progress);
    ASSERT_EQ(volumes.size(), 3U) << name;
    for (std::size_t n = 0; n < 3; ++n) {
      expect_voxels(volumes[n],
                    std::vector<float>(values.begin() + static_cast<std::ptrdiff_t>(n * grid.count()),
                                       values.begin() + static_cast<std::ptrdiff_t>((n + 1) * grid.count())));
    }
    expect_refused(folder / name, std::string(name) == "d.nrrd" ? "input.pixel_type" : "input.dimension");
  }
  fields.datatype = 4;
  fields.bits = 16;
  write_nifti(folder / "series.nii", fields, std::vector<std::int16_t>(3 * grid.count(), 7));
  Progress progress;
  EXPECT_THROW(read_volumes(folder / "series.nii", progress), Error) << "no probabilities";
}

TEST(NiftiReader, NeitherFormGivesSpacingAlone) {
  const TempFolder folder;
  NiftiFields fields;
  fields.pixdim = {1, 0.5F, 0.75F, 2, 1, 1, 1, 1};
  Grid grid;
  grid.origin = {};
  write_nifti(folder / "a.nii", fields, pattern<float>(grid));
  expect_frame(read(folder / "a.nii"), grid);
}

TEST(NiftiReader, UnitsBecomeMillimetres) {
  const TempFolder folder;
  const Grid grid = oblique_grid();
  for (const auto& [units, millimetres] : {std::pair{3, 1e-3}, std::pair{1, 1e3}, std::pair{2 + 8, 1.0}}) {
    Grid stored = grid;
    for (Vec& column : stored.columns) column = (1 / millimetres) * column;
    stored.origin = (1 / millimetres) * grid.origin;
    NiftiFields fields;
    fields.units = static_cast<std::uint8_t>(units);
    fields.sform_code = 1;
    fields.srow = srow_of(stored);
    write_nifti(folder / "a.nii", fields, pattern<float>(grid));
    expect_frame(read(folder / "a.nii"), grid);
  }
}

TEST(NiftiReader, OtherByteOrder) {
  const TempFolder folder;
  const Grid grid = sheared_grid();
  NiftiFields fields;
  fields.sform_code = 1;
  fields.srow = srow_of(grid);
  write_nifti(folder / "a.nii", fields, pattern<float>(grid), true);
  const Scan scan = read(folder / "a.nii");
  expect_frame(scan, grid);
  expect_voxels(scan, pattern<float>(grid));
}

TEST(NiftiReader, HeaderAndImagePairByEitherName) {
  const TempFolder folder;
  const Grid grid = sheared_grid();
  NiftiFields fields;
  fields.magic = "ni1";
  fields.sform_code = 1;
  fields.srow = srow_of(grid);
  write_text(folder / "a.hdr", nifti_header(fields));
  append_values(folder / "a.img", pattern<float>(grid));
  for (const char* name : {"a.hdr", "a.img"}) {
    const Scan scan = read(folder / name);
    expect_frame(scan, grid);
    expect_voxels(scan, pattern<float>(grid));
  }
}

TEST(NiftiReader, AnalyzeIsReadWithItsSpacing) {
  const TempFolder folder;
  NiftiFields fields;
  fields.magic = std::string(3, '\0');
  fields.pixdim = {0, 0.5F, 0.75F, 2, 1, 1, 1, 1};
  Grid grid;
  grid.origin = {};
  write_text(folder / "a.hdr", nifti_header(fields).substr(0, 348));
  append_values(folder / "a.img", pattern<float>(grid));
  const Scan scan = read(folder / "a.hdr");
  EXPECT_EQ(scan.format, "Analyze");
  expect_frame(scan, grid);
  expect_voxels(scan, pattern<float>(grid));
}

TEST(NiftiReader, RescaledValuesInTheTypeTheyHave) {
  const TempFolder folder;
  const Grid grid;
  NiftiFields fields;
  fields.datatype = 4;
  fields.bits = 16;
  fields.slope = 0.5F;
  fields.intercept = -3;
  std::vector<float> expected;
  for (const std::int16_t v : pattern<std::int16_t>(grid)) expected.push_back(0.5F * static_cast<float>(v) - 3);
  write_nifti(folder / "a.nii", fields, pattern<std::int16_t>(grid));
  expect_voxels(read(folder / "a.nii"), expected);
}

TEST(NiftiReader, OneVolumeInFourDimensionsIsThreeDimensional) {
  const TempFolder folder;
  NiftiFields fields;
  fields.dim = {4, 7, 6, 5, 1, 1, 1, 1};
  write_nifti(folder / "a.nii", fields, pattern<float>(Grid{}));
  expect_voxels(read(folder / "a.nii"), pattern<float>(Grid{}));
}

class CancelAt final : public Progress {
 public:
  explicit CancelAt(int reports) : left_(reports) {}
  void report(const ProgressState& state) override {
    EXPECT_EQ(state.stage, "read");
    --left_;
  }
  bool cancelled() const override { return left_ <= 0; }

 private:
  int left_;
};

TEST(ScanReader, CancelledReadGivesAnEmptyScan) {
  const TempFolder folder;
  write_with(itk::NrrdImageIO::New(), folder / "a.nrrd", Grid{}, pattern<float>(Grid{}));
  for (const int reports : {0, 1, 2}) {
    CancelAt progress(reports);
    EXPECT_EQ(read_scan(folder / "a.nrrd", progress).voxel_count(), 0) << reports;
  }
}

TEST(ScanReader, TheScanOutlivesItsCopies) {
  const TempFolder folder;
  write_with(itk::NrrdImageIO::New(), folder / "a.nrrd", Grid{}, pattern<float>(Grid{}));
  Scan copy;
  {
    const Scan scan = read(folder / "a.nrrd");
    copy = scan;
    EXPECT_EQ(std::get<const float*>(copy.voxels), std::get<const float*>(scan.voxels));
  }
  expect_voxels(copy, pattern<float>(Grid{}));
}

}  // namespace
}  // namespace scantet
