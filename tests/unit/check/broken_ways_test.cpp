// Handles of the regions of a grid, and holes in them, that a mesh has not or has too many.
#include <gtest/gtest.h>

#include <memory>

#include "scantet/check/cell_collapse_impl.h"
#include "scantet/check/losses.h"
#include "scantet/domain/analytic.h"
#include "unit/check/region_grids.h"

namespace scantet {
namespace {

using auditing::collapsed;
using auditing::GridCell;
using test::audit_of;
using test::box_without;
using test::codes_of;
using test::grid_mesh;
using test::grid_where;
using test::in_box;

/// All cells with centres from `least` to `most`, in half steps.
std::vector<GridCell> cells_between(const std::array<int, 3>& least, const std::array<int, 3>& most) {
  std::vector<GridCell> cells;
  for (int x = least[0]; x <= most[0]; ++x) {
    for (int y = least[1]; y <= most[1]; ++y) {
      for (int z = least[2]; z <= most[2]; ++z) cells.push_back({{x, y, z}});
    }
  }
  return cells;
}

TEST(CellCollapse, AFreeEndGoes) {
  EXPECT_TRUE(collapsed({{{1, 0, 0}}, {{2, 0, 0}}}).empty()) << "an edge and the node at its end";
  EXPECT_TRUE(collapsed(cells_between({-1, -1, 0}, {1, 1, 1})).empty()) << "around a node at a surface";
  EXPECT_TRUE(collapsed({}).empty());
}

TEST(CellCollapse, OneEdgeIsLeftOfABrokenBar) {
  EXPECT_EQ(collapsed({{{1, 0, 0}}}).size(), 1U);
  const auto thick = collapsed(cells_between({1, 0, 0}, {1, 2, 2}));
  ASSERT_EQ(thick.size(), 1U) << "two by two nodes across";
  ASSERT_EQ(thick[0].size(), 1U);
  EXPECT_EQ(thick[0][0].dimension(), 1);
}

TEST(CellCollapse, HolesAndHollowsStay) {
  const auto hole = collapsed(cells_between({-1, -1, 0}, {1, 1, 0}));
  ASSERT_EQ(hole.size(), 1U);
  EXPECT_EQ(hole[0].size(), 9U) << "all around a node of a sheet";
  const auto hollow = collapsed(cells_between({-1, -1, -1}, {1, 1, 1}));
  ASSERT_EQ(hollow.size(), 1U);
  EXPECT_EQ(hollow[0].size(), 27U);
}

TEST(CellCollapse, WhatIsNotPartOfEachOtherIsInGroups) {
  const auto groups = collapsed({{{7, 0, 0}}, {{1, 0, 0}}, {{3, 0, 0}}, {{2, 0, 0}}});
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].size(), 3U) << "two edges and the node between them";
  EXPECT_EQ(groups[1], (std::vector<GridCell>{{{7, 0, 0}}}));
}

/// A box of nodes with the tunnel that leaving out the cells (2, 2, ·) of a mesh gives.
bool in_pierced_box(int i, int j, int k) {
  return in_box(i, j, k) && !(std::min(i, j) >= 6 && std::max(i, j) <= 7);
}

TEST(BrokenWays, ATunnelThatTheMeshFillsIsFound) {
  const RegionGrid pierced = grid_where(in_pierced_box);
  const AuditReport right = audit_of(box_without([](int i, int j, int) { return i == 2 && j == 2; }), pierced);
  EXPECT_TRUE(right.passed());
  const TetMesh whole = box_without([](int, int, int) { return false; });
  const AuditReport filled = audit_of(whole, pierced);
  ASSERT_EQ(codes_of(filled), std::vector<std::string>{"audit.broken_label"});
  EXPECT_EQ(filled.findings[0].count, 1U);
  EXPECT_NE(filled.findings[0].message.find("in region_0"), std::string::npos) << filled.findings[0].message;
  for (const NarrowWay& way : filled.region_ledger->broken) EXPECT_EQ(way.region, kOutside);
  const AuditReport corner =
      audit_of(box_without([](int i, int j, int k) { return i + j + k == 0; }), grid_where(in_box));
  EXPECT_TRUE(corner.passed()) << "a corner that is cut off is no handle";
}

TEST(BrokenWays, ATunnelThatTheMeshHasTooManyIsFound) {
  const TetMesh pierced = box_without([](int i, int j, int) { return i == 2 && j == 2; });
  const AuditReport report = audit_of(pierced, grid_where(in_box));
  ASSERT_EQ(codes_of(report), std::vector<std::string>{"audit.broken_label"});
  EXPECT_NE(report.findings[0].message.find("in region_1"), std::string::npos) << report.findings[0].message;
}

TEST(BrokenWays, LossesTellTheWaysOfABarThatIsBroken) {
  // A frame of four bars, of which the mesh has three.
  const auto in_frame = [](int i, int j, int k) {
    return in_box(i, j, k) && k <= 3 && (std::min(i, j) <= 3 || std::max(i, j) >= 8);
  };
  const auto is_left_out = [](int i, int j, int k) {
    return k > 0 || (i % 3 != 0 && j % 3 != 0) || (i == 1 && j == 3);
  };
  const UniformSize size(1);
  const std::unique_ptr<Domain> no_curves = make_sphere({}, 1);
  const RegionLosses losses = find_losses(box_without(is_left_out), *no_curves, grid_where(in_frame), size);
  ASSERT_EQ(losses.places.size(), 1U);
  EXPECT_GT(losses.places[0].y, 7) << "on the fourth bar";
  ASSERT_FALSE(losses.ways.empty());
  for (const NarrowWay& way : losses.ways) {
    EXPECT_EQ(way.region, 1);
    EXPECT_GT(way.segment.source.y, 7);
    EXPECT_LE(distance(way.segment.source, way.segment.target), 1);
  }
}

TEST(BrokenWays, AGapFromNodeToNodeIsFound) {
  // A ring of nodes, along the outer edges of a ring of cells between nodes.
  const auto in_ring = [](int i, int j, int k) {
    const bool is_within = std::min(i, j) >= 2 && std::max(i, j) <= 7;
    return k == 2 && is_within && (std::min(i, j) == 2 || std::max(i, j) == 7);
  };
  const auto mesh_with = [](bool has_gap) {
    return grid_mesh(11, [=](int i, int j, int k) -> Region {
      const bool is_within = std::min(i, j) >= 2 && std::max(i, j) <= 6;
      const bool is_ring = k == 2 && is_within && (std::min(i, j) == 2 || std::max(i, j) == 6);
      return is_ring && !(has_gap && i == 4 && j == 2) ? 1 : kOutside;
    });
  };
  const RegionGrid grid = grid_where(in_ring);
  EXPECT_TRUE(audit_of(mesh_with(false), grid).passed());
  const AuditReport report = audit_of(mesh_with(true), grid);
  ASSERT_EQ(codes_of(report), std::vector<std::string>{"audit.broken_label"}) << "all nodes are kept";
  EXPECT_EQ(report.findings[0].where, (Point{4.5, 2, 2}));
  ASSERT_EQ(report.region_ledger->broken.size(), 1U);
}

TEST(BrokenWays, ABarThatTheMeshHasBesideItsVoxelsIsNotBroken) {
  const auto is_end = [](int i, int j) { return (i <= 3 || i >= 8) && j >= 4 && j <= 9; };
  const auto in_bar = [&](int i, int j, int k) {
    return k >= 2 && k <= 3 && i >= 2 && i <= 9 && (is_end(i, j) || j == 8);
  };
  RegionGrid grid = grid_where(in_bar);
  grid.frame = Frame({Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}}, {0, -0.6, 0});
  const auto mesh_with = [](bool has_bar) {
    return box_without([=](int i, int j, int k) { return i % 3 != 0 && !(has_bar && j == 3 && k == 0); });
  };
  EXPECT_TRUE(audit_of(mesh_with(true), grid).passed()) << "it is a quarter of a voxel away";
  EXPECT_EQ(codes_of(audit_of(mesh_with(false), grid)), std::vector<std::string>{"audit.split_label"});
  grid.frame = Frame({Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}}, {0, -1, 0});
  EXPECT_EQ(codes_of(audit_of(mesh_with(true), grid)), std::vector<std::string>{"audit.broken_label"})
      << "too far away";
}

}  // namespace
}  // namespace scantet
