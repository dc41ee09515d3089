// The grid that a mesh is held against: its runs are the voxels, its parts are connected as the field is, its volumes
// are the field's.
#include "scantet/labels/label_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "unit/labels/label_scan.h"

namespace scantet {
namespace {

using test::label_scan;

RegionGrid grid_of(const Scan& scan, LabelSmoothing smoothing = LabelSmoothing::none) {
  LabelSettings settings;
  settings.smoothing = smoothing;
  return region_grid(*make_label_field(scan, settings));
}

TEST(LabelGrid, RunsAreTheVoxels) {
  const std::array<int, 3> size{13, 7, 5};
  const Scan scan = test::label_noise(size, 4, test::oblique());
  const auto field = make_label_field(scan, {});
  const RegionGrid grid = region_grid(*field);
  std::vector<Region> nodes(13 * 7 * 5, kOutside);
  std::uint64_t count = 0;
  for (const GridRun& run : grid.runs) {
    ASSERT_LT(run.begin, run.end);
    for (int i = run.begin; i < run.end; ++i) {
      nodes[static_cast<std::size_t>(run.k * 7 + run.j) * 13 + static_cast<std::size_t>(i)] =
          grid.parts[run.part].region;
      ++count;
    }
  }
  std::uint64_t expected = 0;
  for (const GridRegion& region : grid.regions) expected += region.nodes;
  EXPECT_EQ(count, expected);
  for (int k = 0; k < 5; ++k) {
    for (int j = 0; j < 7; ++j) {
      for (int i = 0; i < 13; ++i) {
        ASSERT_EQ(nodes[static_cast<std::size_t>((k * 7 + j) * 13 + i)], field->region_of_node(i, j, k));
      }
    }
  }
}

TEST(LabelGrid, PartsAreConnectedAsTheFieldIs) {
  const RegionGrid two = grid_of(label_scan({9, 5, 5}, [](int i, int j, int k) {
    return j == 2 && k == 2 && (i == 2 || i == 6) ? 1 : i == 4 && j == 2 && k == 2 ? 2 : 0;
  }));
  ASSERT_EQ(two.parts.size(), 3U);
  EXPECT_EQ(two.parts[0].region, 1);
  EXPECT_EQ(two.parts[0].nodes, 1U);
  EXPECT_EQ(two.parts[0].node, (std::array<int, 3>{2, 2, 2}));
  EXPECT_EQ(two.parts[1].region, 2);
  // Across an edge the fields of one and of two tie in the middle, where the smaller number wins.
  const auto diagonal = [](int first, int second) {
    return grid_of(label_scan({6, 6, 6}, [&](int i, int j, int k) {
      if (k < 2 || k > 3 || i < 2 || i > 3 || j < 2 || j > 3) return 0;
      return (i + j) % 2 == 0 ? first : second;
    }));
  };
  for (const auto& [first, second] : {std::pair{1, 2}, std::pair{2, 1}}) {
    const RegionGrid grid = diagonal(first, second);
    EXPECT_EQ(grid.parts.size(), 3U) << "one region holds together, the other is in two";
    for (const GridPart& part : grid.parts) EXPECT_EQ(part.nodes, part.region == 1 ? 4U : 2U);
  }
}

TEST(LabelGrid, VolumesAreTheFieldS) {
  const double radius = 9.3;
  const Frame frame({Vec{0.5, 0, 0}, Vec{0, -0.5, 0}, Vec{0, 0, 0.5}}, {});
  const auto ball = [&](int i, int j, int k) { return std::hypot(i - 12, j - 12, k - 12) < radius ? 3 : 0; };
  const RegionGrid grid = grid_of(label_scan({25, 25, 25}, ball, frame), LabelSmoothing::keep);
  ASSERT_EQ(grid.regions.size(), 1U);
  EXPECT_EQ(grid.regions[0].region, 3);
  const double expected = 0.125 * static_cast<double>(grid.regions[0].nodes);
  EXPECT_NEAR(grid.regions[0].volume_mm3, expected, 0.005 * expected);
  const RegionGrid cube = grid_of(label_scan({6, 6, 6}, [](int i, int j, int k) {
    return std::min({i, j, k}) > 0 && std::max({i, j, k}) < 5 ? 1 : 0;
  }));
  EXPECT_LT(cube.regions[0].volume_mm3, 64) << "a field of ones and zeros rounds edges off";
  EXPECT_GT(cube.regions[0].volume_mm3, 56);
}

TEST(LabelGrid, SmallPartsAreToldWithTheirMiddle) {
  const Scan scan = label_scan({12, 8, 8}, [](int i, int j, int k) {
    if (j == 3 && k == 3 && i >= 1 && i <= 3) return 1;            // three in a row
    return i >= 6 && i < 10 && j >= 2 && j < 6 && k >= 2 ? 2 : 0;  // many
  });
  const auto field = make_label_field(scan, {});
  const std::vector<GridPart> parts = small_parts(*field, 10);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].region, 1);
  EXPECT_EQ(parts[0].nodes, 3U);
  EXPECT_EQ(parts[0].node, (std::array<int, 3>{2, 3, 3}));
  EXPECT_EQ(small_parts(*field, 1000).size(), 2U);
}

TEST(LabelGrid, SmallCavitiesAreToldToo) {
  const Scan scan = label_scan({12, 12, 12}, [](int i, int j, int k) {
    const bool is_in = std::min({i, j, k}) >= 1 && std::max({i, j, k}) <= 10;
    const bool is_cavity = (i == 4 && j == 4 && (k == 4 || k == 5)) || (i == 8 && j == 8 && k == 8);
    const bool is_dent = i == 5 && j == 5 && k == 1;
    return is_in && !is_cavity && !is_dent ? 1 : 0;
  });
  const auto field = make_label_field(scan, {});
  const std::vector<GridPart> parts = small_parts(*field, 10);
  ASSERT_EQ(parts.size(), 2U) << "what comes to the border of the grid is none";
  EXPECT_EQ(parts[0].region, kOutside);
  EXPECT_EQ(parts[0].nodes, 2U);
  EXPECT_EQ(parts[0].node, (std::array<int, 3>{4, 4, 4}));
  EXPECT_EQ(parts[1].nodes, 1U);
  EXPECT_EQ(parts[1].node, (std::array<int, 3>{8, 8, 8}));
}

TEST(LabelGrid, OfVoxelsOnlyFacesConnect) {
  const Scan scan = label_scan({8, 8, 4}, [](int i, int j, int k) {
    return k == 1 && ((i < 3 && i > 0 && j == 2) || (i == 3 && j == 3) || i == 6) ? 1 : 0;
  });
  const auto field = make_label_field(scan, {});
  const RegionGrid grid = grid_of_voxels(*field);
  ASSERT_EQ(grid.parts.size(), 3U) << "a row, a voxel at its corner, and another row";
  ASSERT_EQ(grid.regions.size(), 1U);
  EXPECT_EQ(grid.regions[0].nodes, 11U);
  EXPECT_DOUBLE_EQ(grid.regions[0].volume_mm3, 11);
}

}  // namespace
}  // namespace scantet
