// Segmentations of 3D Slicer: names, colours and labels from the header, layers merged, and headers that cannot be.
#include "scan_files.h"

namespace scantet {
namespace {

using namespace test;

constexpr std::size_t kVoxels = 4 * 3 * 2;

/// Two layers of 4 × 3 × 2 voxels, side by side: in the first the label 1 where x < 2 and 2 else; in the second 1 where
/// x is 1 or 2.
std::string two_layers(const std::string& keys) {
  std::string file =
      "NRRD0004\ntype: unsigned char\ndimension: 4\nspace: left-posterior-superior\nsizes: 2 4 3 2\nspace directions: "
      "none (1,0,0) (0,1,0) (0,0,1)\nkinds: list domain domain domain\nencoding: raw\nspace origin: (0,0,0)\n" +
      keys + "\n";
  for (std::size_t n = 0; n < kVoxels; ++n) {
    const std::size_t x = n % 4;
    file += static_cast<char>(x < 2 ? 1 : 2);
    file += static_cast<char>(x == 1 || x == 2 ? 1 : 0);
  }
  return file;
}

std::string key(int segment, const std::string& name, const std::string& value) {
  return "Segment" + std::to_string(segment) + "_" + name + ":=" + value + "\n";
}

std::string segment(int number, const std::string& name, int layer, int label) {
  return key(number, "ID", name) + key(number, "Name", name) + key(number, "Layer", std::to_string(layer)) +
         key(number, "LabelValue", std::to_string(label));
}

std::vector<int> row_of(const Scan& scan) {
  const auto* const voxels = std::get<const std::uint16_t*>(scan.voxels);
  return {voxels, voxels + 4};
}

TEST(SegmentLayers, OverlapsGoToTheLastSegment) {
  const TempFolder folder;
  write_text(folder / "a.seg.nrrd", two_layers(segment(0, "left", 0, 1) + segment(10, "tumour", 1, 1) +
                                               segment(2, "right", 0, 2) + key(2, "Color", "0.5 1 0")));
  const Scan scan = read(folder / "a.seg.nrrd");
  EXPECT_EQ(row_of(scan), (std::vector<int>{1, 3, 3, 2})) << "label 1 is there twice: so segments are counted";
  EXPECT_EQ(scan.overlapping, 2U * 3 * 2);
  ASSERT_EQ(scan.segments.size(), 3U);
  EXPECT_EQ(scan.segments[1].name, "right");
  EXPECT_EQ(scan.segments[1].color, (Color{128, 255, 0}));
  EXPECT_EQ(scan.segments[2].name, "tumour");
  EXPECT_EQ(scan.segments[2].label, 3);
  EXPECT_NE(scan.header_of_labels, "");
}

TEST(SegmentLayers, LabelsThatDifferStay) {
  const TempFolder folder;
  std::string file = two_layers(segment(0, "tumour", 1, 9) + segment(1, "left", 0, 1) + segment(2, "right", 0, 2));
  for (std::size_t n = file.size() - 2 * kVoxels + 1; n < file.size(); n += 2) file[n] = static_cast<char>(9 * file[n]);
  write_text(folder / "a.seg.nrrd", file);
  const Scan scan = read(folder / "a.seg.nrrd");
  EXPECT_EQ(row_of(scan), (std::vector<int>{1, 1, 2, 2})) << "the tumour stands first, so the others hide it";
  EXPECT_EQ(scan.segments[0].label, 9);
}

TEST(SegmentLayers, OldFilesHaveASegmentALayer) {
  const TempFolder folder;
  std::string file = two_layers(key(0, "ID", "a") + key(1, "ID", "b"));
  for (std::size_t n = file.size() - 2 * kVoxels; n < file.size(); n += 2) file[n] = static_cast<char>(file[n] == 1);
  write_text(folder / "a.seg.nrrd", file);
  EXPECT_EQ(row_of(read(folder / "a.seg.nrrd")), (std::vector<int>{1, 2, 2, 0}));
}

TEST(SegmentLayers, OneLayerHasNamesAndColours) {
  const TempFolder folder;
  std::string file = "NRRD0004\ntype: unsigned char\ndimension: 3\nsizes: 4 3 2\nencoding: raw\n" +
                     key(0, "LabelValue", "4") + key(0, "Name", "left lung\r") + key(0, "Color", "2 0 0") +
                     key(1, "Name", "no label") + "\n";
  for (std::size_t n = 0; n < kVoxels; ++n) file += static_cast<char>(n % 4 == 0 ? 4 : 0);
  write_text(folder / "a.seg.nrrd", file);
  const Scan scan = read(folder / "a.seg.nrrd");
  ASSERT_EQ(scan.segments.size(), 1U);
  EXPECT_EQ(scan.segments[0].label, 4);
  EXPECT_EQ(scan.segments[0].name, "left lung");
  EXPECT_FALSE(scan.segments[0].color) << "2 is no share";
}

TEST(SegmentLayers, WhatLaterSegmentsCoverIsCounted) {
  const TempFolder folder;
  std::string file = two_layers(segment(0, "tumour", 1, 1) + segment(1, "left", 0, 1) + segment(2, "right", 0, 2));
  for (std::size_t n = file.size() - 2 * kVoxels; n < file.size(); n += 8) file[n] = '\0';  // where x is 0
  write_text(folder / "a.seg.nrrd", file);
  const Scan hidden = read(folder / "a.seg.nrrd");
  ASSERT_EQ(hidden.segments.size(), 3U);
  EXPECT_EQ(hidden.segments[0].voxels, kVoxels / 2);
  EXPECT_EQ(hidden.segments[0].covered, kVoxels / 2) << "nothing is left of the tumour";
  EXPECT_EQ(hidden.segments[1].voxels, kVoxels / 4);
  EXPECT_EQ(hidden.segments[2].voxels, kVoxels / 2);
  EXPECT_EQ(hidden.segments[1].covered + hidden.segments[2].covered, 0U);
  write_text(folder / "b.seg.nrrd",
             two_layers(segment(0, "left", 0, 1) + segment(1, "right", 0, 2) + segment(2, "tumour", 1, 1)));
  const Scan part = read(folder / "b.seg.nrrd");
  EXPECT_EQ(part.segments[0].voxels, kVoxels / 2);
  EXPECT_EQ(part.segments[0].covered, kVoxels / 4);
  EXPECT_EQ(part.segments[2].covered, 0U);
}

TEST(SegmentLayers, LayersWithoutAnySegmentAreOneValueWhereThatIsAllowed) {
  const TempFolder folder;
  std::string file = two_layers(segment(0, "left", 0, 1) + segment(1, "tumour", 1, 1));
  std::fill(file.end() - 2 * kVoxels, file.end(), '\0');
  write_text(folder / "a.seg.nrrd", file);
  EXPECT_NE(expect_refused(folder / "a.seg.nrrd", "input.constant").find("a.seg.nrrd"), std::string::npos);
  Progress progress;
  const Scan scan = read_scan(folder / "a.seg.nrrd", progress, true);
  EXPECT_EQ(scan.min_value, 0);
  EXPECT_EQ(scan.max_value, 0);
  EXPECT_EQ(scan.segments.size(), 2U);
}

TEST(SegmentLayers, ValuesWithoutASegmentAreRefusedInOneLayerToo) {
  const TempFolder folder;
  const auto write = [&](const std::string& type, const auto& values) {
    write_text(folder / "a.seg.nrrd", "NRRD0004\ntype: " + type + "\ndimension: 3\nsizes: 4 3 2\nendian: little\n" +
                                          "encoding: raw\n" + segment(0, "one", 0, 1) + "\n");
    append_values(folder / "a.seg.nrrd", values);
  };
  std::vector<std::uint8_t> bytes(kVoxels, 0);
  bytes[3] = 1;
  write("unsigned char", bytes);
  expect_voxels(read(folder / "a.seg.nrrd"), bytes);
  bytes[20] = 5;
  write("unsigned char", bytes);
  const std::string message = expect_refused(folder / "a.seg.nrrd", "input.labels");
  EXPECT_NE(message.find("value 5, and the header names no such segment"), std::string::npos) << message;
  std::vector<double> numbers(kVoxels, 1);
  numbers[7] = 0;
  write("double", numbers);
  expect_voxels(read(folder / "a.seg.nrrd"), numbers);
  numbers[9] = 1.5;
  write("double", numbers);
  expect_refused(folder / "a.seg.nrrd", "input.labels");
  write("int64", std::vector<std::int64_t>{1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -1});
  expect_refused(folder / "a.seg.nrrd", "input.labels");
}

TEST(SegmentLayers, HeadersThatDoNotFitAreRefused) {
  const TempFolder folder;
  const auto refused = [&](const std::string& keys) {
    write_text(folder / "a.seg.nrrd", two_layers(keys));
    return expect_refused(folder / "a.seg.nrrd", "input.labels");
  };
  const std::string others = segment(1, "left", 0, 1) + segment(2, "right", 0, 2);
  EXPECT_NE(refused(others + segment(0, "a", 2, 1)).find("Segment0_Layer is '2'"), std::string::npos);
  refused(others + segment(0, "a", -1, 1));
  refused(others + segment(0, "a", 1, -1));
  refused(others + segment(0, "a", 1, 0));
  refused(others + key(0, "ID", "a") + key(0, "LabelValue", "99999999999999999999"));
  refused(others + key(0, "ID", "a") + key(0, "Layer", "one"));
  EXPECT_NE(refused(others).find("layer 1 has voxels of the value 1"), std::string::npos);
}

}  // namespace
}  // namespace scantet
