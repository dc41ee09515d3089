// DICOM segmentation objects: labels, shares, names, colours, the stack of their frames, and what is refused.
#include "dicom_segmentation_file.h"
#include "scan_files.h"

namespace scantet {
namespace {

using namespace test;

/// Slices from 10 mm on, 2 mm apart, of which segment 1 has the first and the third, segment 2 the third and the
/// fourth.
SegmentationFile two_segments() {
  SegmentationFile file;
  const auto slice = [](int k) { return Point{-3, 4, 10 + 2.0 * k}; };
  std::vector<std::uint8_t> left(15, 0);
  std::vector<std::uint8_t> right(15, 0);
  for (std::size_t n = 0; n < 15; ++n) {
    left[n] = n % 5 < 3;
    right[n] = n % 5 > 1;
  }
  file.frames = {{1, slice(2), left}, {1, slice(0), left}, {2, slice(2), right}, {2, slice(3), right}};
  return file;
}

std::vector<int> first_row(const Scan& scan, int k) {
  const auto* const voxels = std::get<const std::uint16_t*>(scan.voxels) + 15 * k;
  return {voxels, voxels + 5};
}

TEST(DicomSegmentation, SegmentsBecomeALabelMap) {
  const TempFolder folder;
  for (const bool implicit : {false, true}) {
    SegmentationFile file = two_segments();
    file.implicit = implicit;
    write_text(folder / "a.dcm", file.bytes());
    EXPECT_EQ(can_read_scan(folder / "a.dcm"), 100);
    const Scan scan = read(folder / "a.dcm");
    EXPECT_EQ(scan.size, (std::array<int, 3>{5, 3, 4}));
    EXPECT_EQ(scan.frame.column(0), (Vec{0.75, 0, 0})) << "between columns";
    EXPECT_EQ(scan.frame.column(1), (Vec{0, 0.5, 0}));
    EXPECT_EQ(scan.frame.column(2), (Vec{0, 0, 2}));
    EXPECT_EQ(scan.frame.origin(), (Point{-3, 4, 10}));
    EXPECT_EQ(first_row(scan, 0), (std::vector<int>{1, 1, 1, 0, 0}));
    EXPECT_EQ(first_row(scan, 1), (std::vector<int>{0, 0, 0, 0, 0})) << "no frame has it";
    EXPECT_EQ(first_row(scan, 2), (std::vector<int>{1, 1, 2, 2, 2}));
    EXPECT_EQ(first_row(scan, 3), (std::vector<int>{0, 0, 2, 2, 2}));
    EXPECT_EQ(scan.overlapping, 3U);
    ASSERT_EQ(scan.segments.size(), 2U);
    EXPECT_EQ(scan.segments[0].name, "left");
    EXPECT_EQ(scan.segments[1].label, 2);
    ASSERT_TRUE(scan.segments[0].color);
    EXPECT_GE(scan.segments[0].color->green, 250) << "white";
    EXPECT_NE(scan.header_of_labels.find("BINARY"), std::string::npos);
  }
}

TEST(DicomSegmentation, WhatLaterSegmentsCoverIsCounted) {
  const TempFolder folder;
  SegmentationFile file = two_segments();
  write_text(folder / "a.dcm", file.bytes());
  const Scan part = read(folder / "a.dcm");
  ASSERT_EQ(part.segments.size(), 2U);
  EXPECT_EQ(part.segments[0].voxels, 18U);
  EXPECT_EQ(part.segments[0].covered, 3U);
  EXPECT_EQ(part.segments[1].voxels, 18U);
  EXPECT_EQ(part.segments[1].covered, 0U);
  // Three segments in two slices, the first of which stands in the file last and twice.
  file.names = {"tumour", "liver", "vessel"};
  SegmentFrame tumour = file.frames[0];
  const Point other = file.frames[1].position;
  SegmentFrame liver{2, tumour.position, std::vector<std::uint8_t>(15, 1)};
  SegmentFrame vessel{3, tumour.position, std::vector<std::uint8_t>(15, 0)};
  vessel.pixels[0] = 1;
  file.frames = {vessel, liver, {2, other, liver.pixels}, tumour, tumour};
  write_text(folder / "b.dcm", file.bytes());
  const Scan hidden = read(folder / "b.dcm");
  EXPECT_EQ(first_row(hidden, 1), (std::vector<int>{3, 2, 2, 2, 2}));
  EXPECT_EQ(hidden.overlapping, 9U);
  ASSERT_EQ(hidden.segments.size(), 3U);
  EXPECT_EQ(hidden.segments[0].voxels, 9U);
  EXPECT_EQ(hidden.segments[0].covered, 9U) << "nothing is left of the tumour";
  EXPECT_EQ(hidden.segments[1].voxels, 30U);
  EXPECT_EQ(hidden.segments[1].covered, 1U);
  EXPECT_EQ(hidden.segments[2].voxels, 1U);
}

TEST(DicomSegmentation, LabelMapsAreTakenAsTheyAre) {
  const TempFolder folder;
  SegmentationFile file = two_segments();
  file.kind = "LABELMAP";
  file.frames.erase(file.frames.begin() + 2);
  file.frames[0].pixels[4] = 2;
  write_text(folder / "a.dcm", file.bytes());
  EXPECT_EQ(first_row(read(folder / "a.dcm"), 2), (std::vector<int>{1, 1, 1, 0, 2}));
}

TEST(DicomSegmentation, FractionsBecomeVolumesOfShares) {
  const TempFolder folder;
  SegmentationFile file = two_segments();
  file.kind = "FRACTIONAL";
  for (SegmentFrame& frame : file.frames) {
    for (std::uint8_t& pixel : frame.pixels) pixel = static_cast<std::uint8_t>(51 * pixel);
  }
  write_text(folder / "a.dcm", file.bytes());
  Progress progress;
  const std::vector<Scan> volumes = read_volumes(folder / "a.dcm", progress);
  ASSERT_EQ(volumes.size(), 2U);
  const auto value = [&](std::size_t n, int at) { return std::get<const float*>(volumes[n].voxels)[at]; };
  EXPECT_FLOAT_EQ(value(0, 30), 0.2F);
  EXPECT_FLOAT_EQ(value(1, 30), 0);
  EXPECT_FLOAT_EQ(value(1, 49), 0.2F);
  EXPECT_EQ(volumes[1].segments[1].name, "right");
  expect_refused(folder / "a.dcm", "input.dimension");
}

TEST(DicomSegmentation, WhatCannotBeIsRefused) {
  const TempFolder folder;
  const auto refused = [&](const std::string& code, const auto& damage) {
    SegmentationFile file = two_segments();
    damage(file);
    write_text(folder / "a.dcm", file.bytes());
    return expect_refused(folder / "a.dcm", code);
  };
  refused("input.slices", [](SegmentationFile& file) { file.frames[1].position.x += 1; });
  refused("input.slices", [](SegmentationFile& file) { file.frames[1].position.z += 0.7; });
  refused("input.slices", [](SegmentationFile& file) { file.frames[1].position.z -= 1e7; });
  refused("input.labels", [](SegmentationFile& file) { file.frames[1].segment = 3; });
  refused("input.corrupt", [](SegmentationFile& file) { file.names.clear(); });
  refused("input.corrupt", [](SegmentationFile& file) { file.kind = "SURFACE"; });
  refused("input.corrupt", [](SegmentationFile& file) { file.orientation = "1\\0\\0\\1\\0\\0"; });
  refused("input.corrupt", [](SegmentationFile& file) { file.orientation = "1\\0\\0"; });
  refused("input.corrupt", [](SegmentationFile& file) { file.spacing = "0\\1"; });
  refused("input.corrupt", [](SegmentationFile& file) { file.frames[0].pixels.clear(); });
  const std::string message =
      refused("input.format", [](SegmentationFile& file) { file.syntax = "1.2.840.10008.1.2.5"; });
  EXPECT_NE(message.find("compressed"), std::string::npos);
  const std::string whole = two_segments().bytes();
  for (std::size_t bytes = 140; bytes < whole.size(); bytes += 97) {
    write_text(folder / "a.dcm", whole.substr(0, bytes));
    EXPECT_THROW(read(folder / "a.dcm"), Error) << bytes;
  }
}

}  // namespace
}  // namespace scantet
