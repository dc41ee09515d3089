// Voxels for the page: all of a small scan, those around the mesh of a large one, and what that changes in the frame.
#include "scantet/report/report_scan.h"

#include <gtest/gtest.h>

#include "scantet/field/scan_from_memory.h"

namespace scantet {
namespace {

constexpr int kSide = 20;

/// The value is 1 at a voxel, else 0.
Scan point_scan(int i, int j, int k) {
  std::vector<float> values(std::size_t{kSide} * kSide * kSide, 0);
  values[static_cast<std::size_t>((k * kSide + j) * kSide + i)] = 1;
  const Frame frame({Vec{2, 0, 0}, Vec{0, -1, 0}, Vec{0, 0, 3}}, {10, 20, 30});
  return make_scan(std::move(values), {kSide, kSide, kSide}, frame);
}

/// Where the voxel of the largest value is, in the world.
Point place_of_largest(const ReportScan& shown) {
  const auto at = std::max_element(shown.values.begin(), shown.values.end()) - shown.values.begin();
  const auto row = at / shown.size[0];
  return shown.frame.to_world({double(at % shown.size[0]), double(row % shown.size[1]), double(row / shown.size[1])});
}

TEST(ReportScan, SmallScansAreShownWhole) {
  const Scan scan = point_scan(3, 5, 7);
  const ReportScan shown = report_scan(scan, {{0, 0, 0}, {1, 1, 1}}, {0.5});
  EXPECT_EQ(shown.size, scan.size);
  EXPECT_EQ(shown.note, "");
  EXPECT_EQ(shown.values[(7 * kSide + 5) * kSide + 3], 65535);
  EXPECT_EQ(shown.values[0], 0);
  EXPECT_EQ(shown.levels, std::vector<double>{0.5});
}

TEST(ReportScan, LargeOnesAreCutAndThinned) {
  const Point place = point_scan(8, 10, 12).frame.to_world({8, 10, 12});
  const Box box{place - Vec{4, 2, 6}, place + Vec{4, 2, 6}};
  const ReportScan cut = report_scan(point_scan(8, 10, 12), box, {}, 1000);
  EXPECT_EQ(cut.size, (std::array<int, 3>{9, 9, 9}));
  EXPECT_EQ(cut.note, "of 20 x 20 x 20 voxels those around the mesh are shown");
  EXPECT_EQ(length(place_of_largest(cut) - place), 0);
  const ReportScan thinned = report_scan(point_scan(8, 10, 12), box, {}, 200);
  EXPECT_EQ(thinned.size, (std::array<int, 3>{5, 5, 5}));
  EXPECT_NE(thinned.note.find("one in 2 along each axis"), std::string::npos) << thinned.note;
  EXPECT_EQ(length(place_of_largest(thinned) - place), 0);
}

TEST(ReportScan, AScanOfOneValueIsAllLow) {
  Scan scan = point_scan(3, 5, 7);
  const std::vector<float> sevens(static_cast<std::size_t>(scan.voxel_count()), 7);
  scan.voxels = sevens.data();
  look_at_voxels(scan, "sevens", true);
  const ReportScan shown = report_scan(scan, {}, {7});
  EXPECT_EQ(shown.low, 7);
  EXPECT_EQ(shown.high, 7);
  EXPECT_EQ(shown.values, std::vector<std::uint16_t>(sevens.size(), 0));
}

TEST(ReportScan, AtLeastOneVoxelIsShown) {
  const Scan scan = point_scan(0, 0, 0);
  for (const std::int64_t most : {1, 0, -5}) {
    const ReportScan shown = report_scan(scan, {}, {}, most);
    EXPECT_EQ(shown.values, std::vector<std::uint16_t>{65535}) << most;
  }
}

TEST(ReportScan, LabelsAreShownAsTheirRegions) {
  std::vector<float> labels(8, 0);
  labels[1] = 7;
  labels[2] = 9;
  labels[5] = 1000;
  const Scan scan = make_scan(std::move(labels), {2, 2, 2}, Frame());
  const std::map<std::int64_t, Region> region_of{{0, 0}, {7, 3}, {9, 3}, {1000, 2}};
  const ReportScan shown = report_labels(scan, region_of, nullptr, {});
  EXPECT_EQ(shown.regions, (std::vector<Region>{0, 2, 3}));
  EXPECT_EQ(shown.values, (std::vector<std::uint16_t>{0, 2, 2, 0, 0, 1, 0, 0}));
  EXPECT_TRUE(shown.field.empty());
  const auto field = [](int i, int j, int k) {
    std::vector<std::pair<Region, double>> values;
    if (k == 0) values = {{0, -1 + i}, {3, 1 - j}, {9, 7}};  // 9 is no region of the map
    return values;
  };
  const ReportScan smooth = report_labels(scan, region_of, field, {});
  ASSERT_EQ(smooth.field.size(), 8U);
  EXPECT_EQ(smooth.note, "");
  const ReportFieldValue& first = smooth.field[0];
  EXPECT_EQ(first.voxel, 0U);
  EXPECT_EQ(first.region, 0U);
  EXPECT_EQ(first.value, 0U);
  EXPECT_EQ(smooth.field[1].region, 2U) << "the place of region 3";
  EXPECT_EQ(smooth.field[1].value, 65535U);
  EXPECT_EQ(smooth.field[7].voxel, 3U);
  const ReportScan without = report_labels(scan, region_of, field, {}, 7);
  EXPECT_TRUE(without.field.empty());
  EXPECT_NE(without.note.find("outline is not shown"), std::string::npos);
}

}  // namespace
}  // namespace scantet
