// Grids of whole numbers as label maps.
#include <gtest/gtest.h>

#include <algorithm>

#include "error_code.h"
#include "vdb_plugin_use.h"

namespace scantet {
namespace {

/// Boxes of the labels 4, 7 and 9 beside each other, the first of them a tile of 8³ voxels, the last beyond a gap.
openvdb::Int32Grid::Ptr boxes(int background = 0) {
  openvdb::initialize();
  auto grid = openvdb::Int32Grid::create(background);
  grid->tree().addTile(1, openvdb::Coord(-8, 8, 16), 4, true);
  grid->fill(openvdb::CoordBBox(openvdb::Coord(0, 8, 16), openvdb::Coord(5, 15, 20)), 7);
  grid->fill(openvdb::CoordBBox(openvdb::Coord(9, 9, 17), openvdb::Coord(12, 15, 20)), 9);
  grid->setName("labels");
  return grid;
}

struct Opened {
  std::unique_ptr<Domain> domain;
  std::vector<InfoSection> info;
};

Opened open(const openvdb::GridBase::Ptr& grid, const std::vector<std::pair<std::string, std::string>>& options = {},
            const std::vector<CutPlane>& cuts = {}) {
  return test::use_vdb_plugin(grid, options, [&](InputPlugin& plugin, const std::string& path) -> Opened {
    Progress progress;
    plugin.expect_cuts(cuts);
    return {open_checked(plugin, path, progress).domain, plugin.info(path, progress)};
  });
}

TEST(VdbLabels, WholeNumbersThatFillPlacesAreALabelMap) {
  const Opened opened = open(boxes());
  const auto region = [&](double x, double y, double z) { return opened.domain->region_at({x, y, z}); };
  EXPECT_EQ(region(-7, 10, 20), 4);
  EXPECT_EQ(region(-0.9, 10, 18), 4);
  EXPECT_EQ(region(0.4, 10, 18), 7);
  EXPECT_EQ(region(10, 12, 18), 9);
  EXPECT_EQ(region(7.3, 12, 18), kOutside);
  EXPECT_EQ(region(-9, 10, 20), kOutside);
  ASSERT_EQ(opened.info.size(), 1U);
  const auto entry = [&](const std::string& key) {
    const auto& entries = opened.info[0].entries;
    const auto found = std::find_if(entries.begin(), entries.end(), [&](const InfoEntry& e) { return e.key == key; });
    return found == entries.end() ? InfoValue(std::string("none")) : found->value;
  };
  EXPECT_EQ(entry("voxels_4"), InfoValue(std::int64_t{512}));
  EXPECT_EQ(entry("voxels_9"), InfoValue(std::int64_t{4 * 7 * 4}));
  EXPECT_EQ(entry("parts_7"), InfoValue(std::int64_t{1}));
  EXPECT_EQ(entry("touches_7"), InfoValue(std::vector<double>{0, 4}));
}

TEST(VdbLabels, OptionsChooseAndALevelMeansGreyValues) {
  EXPECT_EQ(open(boxes(), {{"labels", "7"}}).domain->region_at({-7, 10, 20}), kOutside);
  EXPECT_EQ(open(boxes(), {{"level", "3"}}).domain->region_at({1, 10, 18}), 1) << "above 3";
  const auto code = [](const openvdb::GridBase::Ptr& grid,
                       const std::vector<std::pair<std::string, std::string>>& how) {
    return test::error_code([&] { open(grid, how); });
  };
  EXPECT_EQ(code(boxes(), {{"level", "3"}, {"labels", "all"}}), "usage.labels");
  EXPECT_EQ(code(boxes(), {{"labels", "5"}}), "usage.labels");
  EXPECT_EQ(code(boxes(3), {}), "input.background");
  EXPECT_EQ(code(test::fog_grid(), {{"labels", "all"}}), "input.labels");
  auto negative = boxes();
  negative->fill(openvdb::CoordBBox(openvdb::Coord(0, 8, 16), openvdb::Coord(2, 15, 20)), -5);
  EXPECT_EQ(code(negative, {}), "input.labels");
  auto far = boxes();
  far->tree().setValue(openvdb::Coord(700, 700, 700), 9);
  EXPECT_EQ(code(far, {}), "input.too_large");
}

// The interface between 4 and 7 is at x = -0.5, and a cut beyond -0.2 leaves no layer of 4.
TEST(VdbLabels, GoOnToACutBetweenTwoLayers) {
  const Point between{-0.7, 10, 18};
  EXPECT_EQ(open(boxes()).domain->region_at(between), 4);
  EXPECT_EQ(open(boxes(), {}, {{{-1, 0, 0}, 0.2, "cut_1"}}).domain->region_at(between), 7);
}

TEST(VdbLabels, AGridOfYesAndNoIsAMask) {
  openvdb::initialize();
  auto grid = openvdb::BoolGrid::create(false);
  grid->tree().addTile(1, openvdb::Coord(8, 8, 8), true, true);
  grid->fill(openvdb::CoordBBox(openvdb::Coord(16, 10, 10), openvdb::Coord(18, 13, 13)), true);
  grid->tree().setValueOn(openvdb::Coord(20, 10, 10), false);
  grid->tree().setValueOff(openvdb::Coord(17, 17, 10), true);
  grid->setName("mask");
  for (const auto& options : {std::vector<std::pair<std::string, std::string>>{}, {{"labels", "all"}}}) {
    const Opened opened = open(grid, options);
    const auto region = [&](double x, double y, double z) { return opened.domain->region_at({x, y, z}); };
    EXPECT_EQ(region(8, 8, 8), 1);
    EXPECT_EQ(region(16.5, 11, 11), 1) << "no gap between tile and leaf";
    EXPECT_EQ(region(20, 10, 10), kOutside) << "active, and no";
    EXPECT_EQ(region(17, 17, 10), 1) << "inactive, and yes";
    EXPECT_EQ(region(17, 15, 12), kOutside);
  }
}

TEST(VdbLabels, OneTileOfAllVoxelsIsNotWorthTheirMemory) {
  openvdb::initialize();
  auto grid = openvdb::Int64Grid::create(0);
  grid->fill(openvdb::CoordBBox(openvdb::Coord(0, 0, 0), openvdb::Coord(1199, 1199, 1199)), 1);
  grid->tree().setValue(openvdb::Coord(5, 5, 5), 2);
  grid->setName("labels");
  EXPECT_EQ(test::error_code([&] { open(grid, {}); }), "input.too_large") << "14 GB of a file of some kilobytes";
}

}  // namespace
}  // namespace scantet
