#include "scantet/labels/label_field.h"

#include <gtest/gtest.h>

#include "error_code.h"
#include "label_scan.h"
#include "scantet/labels/label_count.h"

namespace scantet {
namespace {

using test::label_noise;
using test::label_scan;

TEST(LabelField, NodesHaveTheirLabelsAndThePaddingIsOutside) {
  const auto label = [](int i, int j, int k) { return (i + 2 * j + 3 * k) % 5; };
  const auto field = make_label_field(label_scan({9, 10, 11}, label), {});
  EXPECT_EQ(field->size(), (std::array<int, 3>{9, 10, 11}));
  EXPECT_EQ(field->regions(), (std::vector<Region>{0, 1, 2, 3, 4}));
  std::array<std::uint64_t, 5> voxels{};
  for (int k = -1; k <= 11; ++k) {
    for (int j = -1; j <= 10; ++j) {
      for (int i = -1; i <= 9; ++i) {
        const bool padding = i < 0 || j < 0 || k < 0 || i == 9 || j == 10 || k == 11;
        EXPECT_EQ(field->region_of_node(i, j, k), padding ? kOutside : label(i, j, k));
        EXPECT_EQ(field->region_at({double(i), double(j), double(k)}), field->region_of_node(i, j, k));
        if (!padding) ++voxels[static_cast<std::size_t>(label(i, j, k))];
      }
    }
  }
  EXPECT_TRUE(std::equal(voxels.begin(), voxels.end(), field->voxels().begin()));
}

TEST(LabelField, CellsHaveTheRegionsAtTheirCornersAndBlocksAreMixedWhereACellIs) {
  for (const int labels : {1, 3, 300}) {  // 300 take 16 bits
    const auto field = make_label_field(test::label_cells({70, 40, 37}, labels), {});
    const auto cells = field->size();
    LabelCell cell;
    int mixed = 0;
    for (int k = -1; k < cells[2]; ++k) {
      for (int j = -1; j < cells[1]; ++j) {
        for (int i = -1; i < cells[0]; ++i) {
          std::vector<Region> corners;
          for (int c = 0; c < 8; ++c) corners.push_back(field->region_of_node(i + c % 2, j + c / 2 % 2, k + c / 4));
          field->cell(i, j, k, cell);
          for (std::size_t c = 0; c < 8; ++c) {
            double sum = 0;
            for (std::size_t n = 0; n < cell.count; ++n) {
              sum += cell.values[n][c];
              if (cell.regions[n] == corners[c]) {
                EXPECT_EQ(cell.values[n][c], 1);
              }
            }
            EXPECT_EQ(sum, 1);
          }
          std::sort(corners.begin(), corners.end());
          corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
          ASSERT_EQ(std::vector<Region>(cell.regions.begin(), cell.regions.begin() + static_cast<long>(cell.count)),
                    corners);
          ASSERT_EQ(field->is_mixed(i, j, k), corners.size() > 1);
          if (corners.size() > 1) {
            ++mixed;
            EXPECT_TRUE(field->nodes().small_is_mixed({i, j, k}));
            EXPECT_TRUE(field->nodes().fine_is_mixed({i, j, k}));
            EXPECT_TRUE(field->nodes().coarse_is_mixed({i, j, k}));
          }
        }
      }
    }
    EXPECT_GT(mixed, 0);
  }
}

TEST(LabelField, LabelsAreGroupedAndDropped) {
  LabelSettings settings;
  settings.region_of = {{1, 7}, {2, 7}, {3, kOutside}};
  const Scan scan = label_noise({12, 12, 12}, 5);
  EXPECT_EQ(make_label_field(scan, settings)->regions(), (std::vector<Region>{0, 4, 5, 7}));
  settings.keep_others = false;
  EXPECT_EQ(make_label_field(scan, settings)->regions(), (std::vector<Region>{0, 7}));
  settings.region_of = {{77, 1}};
  EXPECT_EQ(test::error_code([&] { make_label_field(scan, settings); }), "input.labels") << "all is background";
}

TEST(LabelField, ARegionBelowZeroIsRefused) {
  const Scan scan = label_noise({4, 4, 4}, 5);
  LabelSettings settings;
  settings.region_of = {{1, -2}};
  EXPECT_EQ(test::error_code([&] { make_label_field(scan, settings); }), "usage.labels");
  settings.region_of = {{77, -2}};
  EXPECT_EQ(test::error_code([&] { regions_of_labels({0, 1}, settings); }), "usage.labels") << "of any label";
}

TEST(LabelField, AnotherBackgroundLeavesZeroANumber) {
  LabelSettings settings;
  settings.background = 3;
  EXPECT_EQ(make_label_field(label_noise({12, 12, 12}, 5), settings)->regions(),
            (std::vector<Region>{0, 1, 2, 4, 5, 6}));
  EXPECT_EQ(regions_of_labels({0, 1, 3}, settings), (std::vector<Region>{2, 1, 0}));
}

TEST(LabelField, WhatIsNoLabelIsRefused) {
  const auto refused = [](auto voxel, auto value) {
    using Voxel = decltype(voxel);
    const Scan scan = label_scan<Voxel>({4, 4, 4}, [&](int i, int, int) { return i == 2 ? value : 1; });
    return test::error_code([&] { count_labels(scan); });
  };
  EXPECT_EQ(refused(std::int16_t{}, -1), "input.labels");
  EXPECT_EQ(refused(float{}, 1.5), "input.labels");
  EXPECT_EQ(refused(double{}, 3e9), "input.labels");
  EXPECT_EQ(refused(std::uint32_t{}, 2147483648U), "input.labels");
  const Scan far = label_scan<std::int64_t>({4, 4, 4}, [](int i, int, int) { return i == 2 ? 2147483647 : i; });
  EXPECT_EQ(count_labels(far).back().voxels, 16U);
  EXPECT_EQ(labels_of(count_labels(far)), (std::vector<std::int64_t>{0, 1, 3, 2147483647}));
  EXPECT_EQ(make_label_field(far, {})->regions(), (std::vector<Region>{0, 1, 3, 2147483647}));
}

}  // namespace
}  // namespace scantet
