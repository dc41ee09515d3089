// DICOM folders, written slice by slice through GDCM: stacking, choosing a series, and what is refused.
#include <itkGDCMImageIO.h>
#include <itkMetaDataObject.h>

#include <sstream>

#include "scan_files.h"
#include "scantet/field/scan_statistics.h"

namespace scantet {
namespace {

using namespace test;

const std::string kRoot = "1.2.826.0.1.3680043.2.1125.";

struct SliceTags {
  std::string series = kRoot + "1";
  std::string description = "thorax";
  int intercept = 0;  // Rescale Intercept: not 0, and GDCM yields 32-bit voxels
  bool with_position = true;
};

std::string joined(const Vec& v) {
  std::ostringstream text;
  text.precision(12);
  text << v.x << "\\" << v.y << "\\" << v.z;
  return text.str();
}

// One slice of the grid's frame, at `position`, as a CT file.
void write_slice(const std::string& path, const Grid& grid, const Point& position,
                 const std::vector<std::int16_t>& values, const SliceTags& tags = {}, int instance = 1) {
  const auto io = itk::GDCMImageIO::New();
  io->SetKeepOriginalUID(true);
  auto& dictionary = io->GetMetaDataDictionary();
  const auto put = [&](const char* tag, const std::string& value) {
    itk::EncapsulateMetaData<std::string>(dictionary, tag, value);
  };
  put("0008|0016", "1.2.840.10008.5.1.4.1.1.2");  // CT image
  put("0008|0018", tags.series + "." + std::to_string(instance));
  put("0008|0060", "CT");
  put("0008|103e", tags.description);
  put("0020|000d", kRoot + "9");
  put("0020|000e", tags.series);
  put("0020|0013", std::to_string(instance));
  if (tags.with_position) {
    put("0020|0032", joined(position));
    put("0020|0037", joined((1 / length(grid.columns[0])) * grid.columns[0]) + "\\" +
                         joined((1 / length(grid.columns[1])) * grid.columns[1]));
  }
  if (tags.intercept != 0) {
    put("0028|1053", "1");
    put("0028|1052", std::to_string(tags.intercept));
  }
  Grid slice = grid;
  slice.size[2] = 1;
  slice.origin = position;
  write_with(io, path, slice, values, 1, 2);
}

std::vector<std::int16_t> slice_values(const Grid& grid, const std::vector<std::int16_t>& all, int k) {
  const std::ptrdiff_t area = std::ptrdiff_t{grid.size[0]} * grid.size[1];
  return {all.begin() + k * area, all.begin() + (k + 1) * area};
}

std::vector<std::int16_t> small_pattern(const Grid& grid) {
  std::vector<std::int16_t> values;
  for (const std::uint8_t v : pattern<std::uint8_t>(grid)) values.push_back(static_cast<std::int16_t>(10 * v - 700));
  return values;
}

// The file names run against the order of the slices.
void write_series(const TempFolder& folder, const Grid& grid, const SliceTags& tags = {}, const char* prefix = "im") {
  const auto values = small_pattern(grid);
  for (int k = 0; k < grid.size[2]; ++k) {
    const Point position = grid.origin + static_cast<double>(k) * grid.columns[2];
    write_slice(folder / (prefix + std::to_string(50 - k) + ".dcm"), grid, position, slice_values(grid, values, k),
                tags, k + 1);
  }
}

// The code of the refusal; "" if the scan is read.
std::string code_of(const std::string& path) {
  try {
    read(path);
  } catch (const Error& error) {
    return error.code();
  }
  return "";
}

// Right-handed, as a stack sorted along its normal is.
Grid dicom_grid() {
  Grid grid = oblique_grid();
  grid.columns[2] = -1.0 * grid.columns[2];
  return grid;
}

TEST(DicomSeries, ReadsAnObliqueStackInSpatialOrder) {
  const TempFolder folder;
  const Grid grid = dicom_grid();
  write_series(folder, grid);
  EXPECT_EQ(can_read_scan(folder.path()), 100);
  const Scan scan = read(folder.path());
  EXPECT_EQ(scan.format, "DICOM");
  expect_voxels(scan, small_pattern(grid));
  expect_frame(scan, grid);
}

TEST(DicomSeries, TiltedGantryIsShear) {
  const TempFolder folder;
  Grid grid = dicom_grid();
  grid.columns[2] = grid.columns[2] + 0.6 * grid.columns[1];
  write_series(folder, grid);
  const Scan scan = read(folder.path());
  expect_frame(scan, grid);
  EXPECT_TRUE(orientation_of(scan.frame).sheared);
}

TEST(DicomSeries, RescaledSlicesOfDifferentTypesBecomeDouble) {
  const TempFolder folder;
  const Grid grid = dicom_grid();
  const auto values = small_pattern(grid);
  for (int k = 0; k < grid.size[2]; ++k) {
    SliceTags tags;
    tags.intercept = k == 2 ? -24 : 0;
    write_slice(folder / (std::to_string(k) + ".dcm"), grid, grid.origin + double(k) * grid.columns[2],
                slice_values(grid, values, k), tags, k + 1);
  }
  expect_voxels(read(folder.path()), std::vector<double>(values.begin(), values.end()));
}

TEST(DicomSeries, SeveralSeriesAreListedAndOneCanBeChosen) {
  const TempFolder folder;
  const Grid grid = dicom_grid();
  Grid other = grid;
  other.size[2] = 3;
  write_series(folder, grid);
  write_series(folder, other, {kRoot + "2", "scout", 0, true}, "other");
  const std::string message = expect_refused(folder.path(), "input.series");
  for (const char* part : {"1125.1", "1125.2", "thorax", "scout", "5 slices", "3 slices", ":UID"}) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
  EXPECT_EQ(can_read_scan(folder.path() + ":" + kRoot + "2"), 100);
  expect_frame(read(folder.path() + ":" + kRoot + "2"), other);
  expect_frame(read(folder.path() + ":" + kRoot + "1"), grid);
  EXPECT_EQ(code_of(folder.path() + ":" + kRoot), "input.series");
  EXPECT_EQ(code_of(folder.path() + ":5.5"), "input.series");
}

TEST(DicomSeries, RefusesAMissingSlice) {
  const TempFolder folder;
  const Grid grid = dicom_grid();
  write_series(folder, grid);
  std::filesystem::remove(folder / "im48.dcm");
  try {
    read(folder.path());
    FAIL() << "stacked slices around a gap";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), "input.slices");
    std::ostringstream gap;
    gap << "has a gap of " << 2 * length(grid.columns[2]) << " mm between 'im49.dcm' at (";
    const std::string text = error.what();
    EXPECT_NE(text.find(gap.str()), std::string::npos) << text << gap.str();
    EXPECT_NE(text.find("and 'im47.dcm' at ("), std::string::npos) << text;
    EXPECT_NE(text.find("so 1 of them seems missing there"), std::string::npos) << text;
    EXPECT_NE(error.remedy().find("one side of the gap"), std::string::npos) << error.remedy();
  }
}

TEST(DicomSeries, TellsTheWidestOfSeveralGaps) {
  const TempFolder folder;
  Grid grid = dicom_grid();
  grid.size[2] = 12;
  write_series(folder, grid);
  for (const char* file : {"im48.dcm", "im45.dcm", "im44.dcm"}) std::filesystem::remove(folder / file);
  const std::string message = expect_refused(folder.path(), "input.slices");
  EXPECT_NE(message.find("between 'im46.dcm'"), std::string::npos) << message;
  EXPECT_NE(message.find("so 2 of them seem missing there, and 3 in all 2 gaps"), std::string::npos) << message;
}

TEST(DicomSeries, RefusesUnevenSlicesWithoutAGap) {
  const TempFolder folder;
  const Grid grid = dicom_grid();
  const auto values = small_pattern(grid);
  for (int k = 0; k < grid.size[2]; ++k) {
    const double place = k == 2 ? 2.3 : k;
    write_slice(folder / (std::to_string(k) + ".dcm"), grid, grid.origin + place * grid.columns[2],
                slice_values(grid, values, k), {}, k + 1);
  }
  const std::string message = expect_refused(folder.path(), "input.slices");
  EXPECT_NE(message.find("off an even stack"), std::string::npos) << message;
}

TEST(DicomSeries, ASingleSliceAsksForTheFolder) {
  const TempFolder folder;
  write_series(folder, dicom_grid());
  const std::string message = expect_refused(folder / "im48.dcm", "input.dimension");
  EXPECT_NE(message.find("folder"), std::string::npos) << message;
}

TEST(DicomSeries, RefusesTwoVolumesInOneSeries) {
  const TempFolder folder;
  const Grid grid = dicom_grid();
  write_series(folder, grid);
  write_series(folder, grid, {}, "again");
  expect_refused(folder.path(), "input.dimension");
}

TEST(DicomSeries, RefusesASliceOfAnotherOrientation) {
  const TempFolder folder;
  const Grid grid = dicom_grid();
  write_series(folder, grid);
  Grid turned = grid;
  std::swap(turned.columns[0], turned.columns[2]);
  write_slice(folder / "scout.dcm", turned, turned.origin, slice_values(grid, small_pattern(grid), 0), {}, 40);
  try {
    read(folder.path());
    FAIL() << "stacked slices of two orientations";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), "input.slices") << error.what();
    EXPECT_NE(std::string(error.what()).find("scout.dcm"), std::string::npos) << error.what();
  }
}

TEST(DicomSeries, RefusesFoldersWithoutDicom) {
  const TempFolder folder;
  expect_refused(folder.path(), "input.format");
  write_text(folder / "notes.txt", "nothing to see");
  expect_refused(folder.path(), "input.format");
  EXPECT_EQ(can_read_scan(folder.path()), 10);
}

TEST(DicomSeries, OtherFilesInTheFolderAreIgnored) {
  const TempFolder folder;
  const Grid grid = dicom_grid();
  write_series(folder, grid);
  write_text(folder / "notes.txt", "nothing to see");
  write_text(folder / "empty", "");
  std::filesystem::create_directory(folder / "nested");
  expect_frame(read(folder.path()), grid);
}

TEST(DicomSeries, RefusesATruncatedSlice) {
  const TempFolder folder;
  const Grid grid = dicom_grid();
  write_series(folder, grid);
  const std::string whole = bytes_of(folder / "im49.dcm");
  write_text(folder / "im49.dcm", whole.substr(0, whole.size() - 40));
  EXPECT_EQ(code_of(folder.path()), "input.corrupt");
}

TEST(DicomSeries, CancelledBetweenSlices) {
  class Cancel final : public Progress {
   public:
    void report(const ProgressState& state) override { slices_ += state.doing == "slices"; }
    bool cancelled() const override { return slices_ >= 2; }
    int slices_ = 0;
  };
  const TempFolder folder;
  write_series(folder, dicom_grid());
  Cancel progress;
  EXPECT_EQ(read_scan(folder.path(), progress).voxel_count(), 0);
  EXPECT_EQ(progress.slices_, 2);
}

// One element in explicit little-endian syntax.
std::string element(unsigned group, unsigned number, const std::string& type, std::string value) {
  if (value.size() % 2 == 1) value += type == "UI" ? '\0' : ' ';
  const auto bytes = [](std::size_t n, int count) {
    std::string raw;
    for (int k = 0; k < count; ++k) raw += static_cast<char>(n >> 8 * k & 0xff);
    return raw;
  };
  const bool is_long = type == "SQ" || type == "OW";
  return bytes(group, 2) + bytes(number, 2) + type + (is_long ? bytes(0, 2) : "") +
         bytes(value.size(), is_long ? 4 : 2) + value;
}

std::string item(const std::string& content) {
  std::string raw = element(0xfffe, 0xe000, "OW", content);
  return raw.erase(4, 4);  // items have no type
}

std::string number16(int n) {
  return {static_cast<char>(n & 0xff), static_cast<char>(n >> 8)};
}

// An enhanced CT: one file, a position for each frame.
std::string enhanced_file(const Grid& grid, const std::vector<std::int16_t>& values, const std::vector<Point>& frames) {
  const std::string enhanced_ct = "1.2.840.10008.5.1.4.1.1.2.1";
  std::string meta = element(2, 2, "UI", enhanced_ct) + element(2, 3, "UI", kRoot + "7") +
                     element(2, 0x10, "UI", "1.2.840.10008.1.2.1");
  meta = element(2, 0, "UL", number16(static_cast<int>(meta.size())) + number16(0)) + meta;
  std::ostringstream spacing;
  spacing << length(grid.columns[1]) << "\\" << length(grid.columns[0]);
  const std::string orientation = joined((1 / length(grid.columns[0])) * grid.columns[0]) + "\\" +
                                  joined((1 / length(grid.columns[1])) * grid.columns[1]);
  const std::string shared =
      element(0x20, 0x9116, "SQ", item(element(0x20, 0x37, "DS", orientation))) +
      element(0x28, 0x9110, "SQ", item(element(0x18, 0x50, "DS", "2") + element(0x28, 0x30, "DS", spacing.str())));
  std::string positions;
  for (const Point& p : frames) {
    positions += item(element(0x20, 0x9113, "SQ", item(element(0x20, 0x32, "DS", joined(p)))));
  }
  std::string voxels(reinterpret_cast<const char*>(values.data()), 2 * values.size());
  return std::string(128, '\0') + "DICM" + meta + element(8, 0x16, "UI", enhanced_ct) +
         element(8, 0x18, "UI", kRoot + "7") + element(8, 0x60, "CS", "CT") + element(0x20, 0xd, "UI", kRoot + "9") +
         element(0x20, 0xe, "UI", kRoot + "3") + element(0x28, 2, "US", number16(1)) +
         element(0x28, 4, "CS", "MONOCHROME2") + element(0x28, 8, "IS", std::to_string(frames.size())) +
         element(0x28, 0x10, "US", number16(grid.size[1])) + element(0x28, 0x11, "US", number16(grid.size[0])) +
         element(0x28, 0x100, "US", number16(16)) + element(0x28, 0x101, "US", number16(16)) +
         element(0x28, 0x102, "US", number16(15)) + element(0x28, 0x103, "US", number16(1)) +
         element(0x5200, 0x9229, "SQ", item(shared)) + element(0x5200, 0x9230, "SQ", positions) +
         element(0x7fe0, 0x10, "OW", voxels);
}

std::vector<Point> frames_of(const Grid& grid) {
  std::vector<Point> frames;
  for (int k = 0; k < grid.size[2]; ++k) frames.push_back(grid.origin + double(k) * grid.columns[2]);
  return frames;
}

// Frames may run against the normal of the slices: GDCM alone would mirror the patient.
TEST(EnhancedDicom, FramesLieWhereTheFileSays) {
  const TempFolder folder;
  for (const Grid& grid : {dicom_grid(), oblique_grid()}) {
    write_text(folder / "a.dcm", enhanced_file(grid, small_pattern(grid), frames_of(grid)));
    for (const std::string& path : {folder / "a.dcm", folder.path()}) {
      const Scan scan = read(path);
      expect_voxels(scan, small_pattern(grid));
      expect_frame(scan, grid);
    }
  }
}

TEST(EnhancedDicom, RefusesFramesOutOfOrder) {
  const TempFolder folder;
  const Grid grid = dicom_grid();
  std::vector<Point> frames = frames_of(grid);
  std::swap(frames[1], frames[2]);
  write_text(folder / "a.dcm", enhanced_file(grid, small_pattern(grid), frames));
  expect_refused(folder / "a.dcm", "input.slices");
}

TEST(EnhancedDicom, RefusesAFileThatEndsEarlyWithoutEndingTheProcess) {
  const TempFolder folder;
  const Grid grid = dicom_grid();
  const std::string whole = enhanced_file(grid, small_pattern(grid), frames_of(grid));
  testing::internal::CaptureStderr();
  for (std::size_t kept = 1; kept < whole.size(); kept += 3) {
    write_text(folder / "a.dcm", whole.substr(0, kept));
    const std::string code = code_of(folder / "a.dcm");
    EXPECT_TRUE(code == "input.corrupt" || code == "input.format") << kept << ": " << code;
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace scantet
