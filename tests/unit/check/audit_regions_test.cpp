// A mesh held against a grid of regions: which nodes lie in tets of their region.
#include <gtest/gtest.h>

#include <set>

#include "boundary_flags.h"
#include "scantet/check/audit.h"
#include "scantet/check/losses.h"
#include "scantet/domain/analytic.h"
#include "unit/check/region_grids.h"

namespace scantet {
namespace {

using test::audit_of;
using test::box_without;
using test::codes_of;
using test::grid_where;
using test::in_box;
using test::kNodes;

/// A grid around a box whose left half is region 1 and right half region 2, `shift` to the right of where the mesh is.
RegionGrid two_halves(double shift, const Frame& frame) {
  RegionGrid grid;
  grid.frame = frame;
  grid.size = {kNodes, kNodes, kNodes};
  grid.parts = {{1, 0, {2, 2, 2}}, {2, 0, {6, 2, 2}}};
  const int middle = static_cast<int>(std::ceil(5.5 + shift));
  for (int k = 2; k <= 9; ++k) {
    for (int j = 2; j <= 9; ++j) {
      grid.runs.push_back({j, k, 2, middle, 0});
      grid.runs.push_back({j, k, middle, 10, 1});
    }
  }
  const auto nodes = [](int width) { return 64 * static_cast<std::uint64_t>(width); };
  grid.regions = {{1, nodes(middle - 2), 0}, {2, nodes(10 - middle), 0}};
  return grid;
}

/// grid_where(), all in one part.
template <class In>
RegionGrid one_part(const In& in) {
  RegionGrid grid = grid_where(in);
  grid.parts = {{1, grid.regions[0].nodes, grid.parts[0].node}};
  for (GridRun& run : grid.runs) run.part = 0;
  return grid;
}

/// A box from 1.5 to 9.5 along each axis of the grid, cut into two regions in the middle.
TetMesh halved_box(const Frame& frame) {
  TetMesh mesh = test::grid_mesh(4, [](int i, int, int) { return i < 2 ? 1 : 2; });
  Box box;
  for (const Point& p : mesh.vertices) box.extend(p);
  for (Point& p : mesh.vertices) {
    Vec index;
    for (int axis = 0; axis < 3; ++axis) {
      index[axis] = 1.5 + 8 * (p[axis] - box.min[axis]) / (box.max[axis] - box.min[axis]);
    }
    p = frame.to_world(index);
  }
  return mesh;
}

TEST(AuditRegions, AllNodesAreKeptWhereTheMeshIsTheGrid) {
  for (const Frame& frame : {Frame(), Frame({Vec{0.5, 0.2, 0}, Vec{-0.2, 0.7, 0.1}, Vec{0, 0, 1.5}}, {100, -20, 7})}) {
    const TetMesh mesh = halved_box(frame);
    const AuditReport report = audit_of(mesh, two_halves(0, frame));
    ASSERT_TRUE(report.complete);
    EXPECT_TRUE(report.passed());
    ASSERT_TRUE(report.region_ledger.has_value());
    ASSERT_EQ(report.region_ledger->regions.size(), 3U);
    std::uint64_t nodes = 0;
    for (const KeptRegion& region : report.region_ledger->regions) {
      EXPECT_EQ(region.kept, region.grid.nodes) << region.grid.region;
      EXPECT_TRUE(region.lost.empty());
      nodes += region.grid.nodes;
    }
    EXPECT_EQ(nodes, 12U * 12 * 12);
    EXPECT_EQ(report.region_ledger->regions[1].parts, 1U);
  }
}

TEST(AuditRegions, NodesInAnotherRegionAreListed) {
  const AuditReport report = audit_of(halved_box({}), two_halves(1, {}));
  EXPECT_TRUE(report.passed()) << "some nodes of each are kept";
  const std::vector<KeptRegion>& regions = report.region_ledger->regions;
  EXPECT_EQ(regions[0].kept, regions[0].grid.nodes);
  EXPECT_EQ(regions[1].grid.nodes - regions[1].kept, 64U) << "a layer is in region 2";
  ASSERT_EQ(regions[1].lost.size(), 64U);
  EXPECT_EQ(regions[1].lost.front().x, 6);
  EXPECT_EQ(regions[2].kept, regions[2].grid.nodes);
}

TEST(AuditRegions, NodesOnFacesCountForBothSides) {
  RegionGrid grid = two_halves(0, Frame({Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}}, {0.5, 0, 0}));
  const AuditReport report = audit_of(halved_box({}), grid);
  EXPECT_EQ(report.region_ledger->regions[1].kept, report.region_ledger->regions[1].grid.nodes);
}

TEST(AuditRegions, PartsThatTheMeshHasNothingOfAreFound) {
  RegionGrid grid = two_halves(0, {});
  grid.parts.push_back({1, 2, {10, 10, 10}});
  grid.runs.push_back({10, 10, 10, 12, 2});
  grid.regions[0].nodes += 2;
  const AuditReport report = audit_of(halved_box({}), grid);
  ASSERT_EQ(report.findings.size(), 1U);
  EXPECT_EQ(report.findings[0].code, "audit.lost_label");
  EXPECT_NE(report.findings[0].message.find("2 voxels of region_1"), std::string::npos) << report.findings[0].message;
  EXPECT_EQ(report.findings[0].where.x, 10);
  ASSERT_EQ(report.region_ledger->lost.size(), 1U);
  EXPECT_EQ(report.region_ledger->lost[0].nodes, 2U);
}

TEST(AuditRegions, PartsThatTheMeshKeepsLittleOfAreFound) {
  // Layers of cells, and a bar.
  const auto mesh_with = [](int layers) {
    return box_without([=](int i, int j, int k) { return i >= layers && std::max(j, k) > 0; });
  };
  const AuditReport report = audit_of(mesh_with(1), one_part(in_box));
  ASSERT_EQ(codes_of(report), std::vector<std::string>{"audit.shrunk_label"});
  EXPECT_NE(report.findings[0].message.find("152 of 512 voxels of region_1 kept"), std::string::npos)
      << report.findings[0].message;
  EXPECT_EQ(report.region_ledger->missed.size(), 360U);
  EXPECT_EQ(report.region_ledger->broken.size(), 6U * 60 + 6U * (2 * 7 * 8 - 4))
      << "along i, and across: those of the bar itself are no ways";
  EXPECT_TRUE(audit_of(mesh_with(2), one_part(in_box)).passed()) << "over a half is kept";
  const auto in_bar = [](int i, int j, int k) { return in_box(i, j, k) && i < 5 && j < 4 && k > 5; };
  EXPECT_TRUE(audit_of(mesh_with(1), one_part(in_bar)).passed()) << "less than half of 24 nodes, but these are few";
}

TEST(AuditRegions, PartsThatTheMeshJoinsAreFound) {
  const TetMesh whole = box_without([](int, int, int) { return false; });
  const RegionGrid halves = grid_where([](int i, int j, int k) { return in_box(i, j, k) && i != 5; });
  const AuditReport report = audit_of(whole, halves);
  ASSERT_EQ(codes_of(report), (std::vector<std::string>{"audit.joined_label", "audit.broken_label"}));
  EXPECT_EQ(report.findings[1].where.x, 5) << "the wall between them";
  EXPECT_EQ(report.findings[0].count, 1U);
  EXPECT_NE(report.findings[0].message.find("256 voxels of region_1, with 192 voxels of region_1"), std::string::npos)
      << report.findings[0].message;
  EXPECT_EQ(report.findings[0].where.x, 5) << "between the two";
  const RegionGrid diagonal = grid_where([](int i, int j, int k) { return in_box(i, j, k) && (i < 6) == (j < 6); });
  EXPECT_TRUE(audit_of(whole, diagonal).passed()) << "quarters that touch along an edge may be joined";
}

TEST(AuditRegions, PartsThatTheMeshSplitsAreFound) {
  const TetMesh halves = box_without([](int i, int, int) { return i == 2; });
  const AuditReport report = audit_of(halves, grid_where(in_box));
  ASSERT_EQ(codes_of(report), std::vector<std::string>{"audit.split_label"});
  EXPECT_NE(report.findings[0].message.find("128 of 512 voxels of region_1"), std::string::npos)
      << report.findings[0].message;
  EXPECT_EQ(report.findings[0].where.x, 6.5) << "midway between the two";
  const AuditReport columns =
      audit_of(box_without([](int i, int j, int) { return i % 2 == 1 || j % 2 == 1; }), grid_where(in_box));
  const Finding& torn = columns.findings.back();
  ASSERT_EQ(torn.code, "audit.split_label");
  EXPECT_EQ(torn.count, 3U) << "all of the four but the largest";
  EXPECT_EQ(torn.places.size(), 3U) << "each has a place of its own";
}

TEST(AuditRegions, PartsThatTouchAlongAnEdgeAndComeApartAreFound) {
  const auto in_quarters = [](int i, int j, int k) { return in_box(i, j, k) && (i < 6) == (j < 6); };
  const TetMesh quarters = box_without([](int i, int j, int) { return (i < 2) != (j < 2); });
  const AuditReport apart = audit_of(quarters, one_part(in_quarters));
  const Finding& torn = apart.findings.back();
  ASSERT_EQ(torn.code, "audit.split_label");
  EXPECT_EQ(torn.count, 1U);
  EXPECT_EQ(torn.where, (Point{5.5, 5.5, 2}));
  EXPECT_NE(torn.message.find("128 voxels of region_1, which touch others by edges or corners"), std::string::npos)
      << torn.message;
  EXPECT_EQ(apart.region_ledger->contacts.size(), 8U + 2 * 7U) << "by an edge, and by corners";
  EXPECT_EQ(codes_of(audit_of(quarters, grid_where(in_quarters))), std::vector<std::string>{"audit.boundary_edge"})
      << "the field has them apart";
}

TEST(AuditRegions, CavitiesThatTheMeshHasNotAreFound) {
  const TetMesh whole = box_without([](int, int, int) { return false; });
  const TetMesh hollow = box_without([](int i, int j, int k) { return i == 2 && j == 2 && k == 2; });
  const TetMesh open = box_without([](int i, int j, int k) { return i == 2 && j == 2 && k >= 2; });
  const auto in_cavity = [](int i, int j, int k) { return std::min({i, j, k}) >= 6 && std::max({i, j, k}) <= 7; };
  const RegionGrid grid = grid_where([&](int i, int j, int k) { return in_box(i, j, k) && !in_cavity(i, j, k); });
  EXPECT_TRUE(audit_of(hollow, grid).passed());
  const AuditReport filled = audit_of(whole, grid);
  ASSERT_EQ(codes_of(filled), std::vector<std::string>{"audit.cavity_missing"});
  EXPECT_NE(filled.findings[0].message.find("the one of 8 voxels"), std::string::npos) << filled.findings[0].message;
  EXPECT_EQ(filled.findings[0].where.x, 6);
  const AuditReport opened = audit_of(open, grid);
  ASSERT_EQ(codes_of(opened), (std::vector<std::string>{"audit.cavity_joined", "audit.broken_label"}));
  EXPECT_NE(opened.findings[0].message.find("the one of 8 voxels"), std::string::npos) << opened.findings[0].message;
  const RegionGrid by_corners = grid_where([&](int i, int j, int k) { return in_box(i, j, k) && (i != j || j != k); });
  EXPECT_TRUE(audit_of(whole, by_corners).passed()) << "what the outside touches by a corner may be no cavity";
}

TEST(AuditRegions, CavitiesThatTheMeshHasInOneOrOpenAreFoundWhereTheyAre) {
  // One node in each of three cells of the mesh along x, and solid nodes between them.
  const auto is_hole = [](int i, int j, int k) { return j == 4 && k == 4 && (i == 4 || i == 6 || i == 8); };
  const RegionGrid grid = grid_where([&](int i, int j, int k) { return in_box(i, j, k) && !is_hole(i, j, k); });
  const auto mesh_without = [](std::set<int> cells) {
    return box_without([=](int i, int j, int k) { return j == 1 && k == 1 && cells.contains(i); });
  };
  // What is solid between them is lost, too.
  const std::vector<std::string> codes{"audit.lost_label", "audit.cavity_missing", "audit.cavity_joined",
                                       "audit.broken_label"};
  const AuditReport in_one = audit_of(mesh_without({1, 2}), grid);
  ASSERT_EQ(codes_of(in_one), codes);
  EXPECT_EQ(in_one.findings[1].places, (std::vector<Point>{{8, 4, 4}}));
  EXPECT_EQ(in_one.findings[2].places, (std::vector<Point>{{6, 4, 4}}));
  const AuditReport open = audit_of(mesh_without({1, 3}), grid);
  ASSERT_EQ(codes_of(open), codes);
  EXPECT_EQ(open.findings[1].places, (std::vector<Point>{{6, 4, 4}}));
  EXPECT_EQ(open.findings[2].places, (std::vector<Point>{{8, 4, 4}})) << "the mesh has a cavity, but not this one";
}

TEST(AuditRegions, CavitiesInTheIslandsOfOthersAreToldApart) {
  const auto shell = [](int i, int j, int k) {
    return std::max({std::abs(2 * i - 11), std::abs(2 * j - 11), std::abs(2 * k - 11)}) / 2;
  };
  const RegionGrid grid = grid_where([&](int i, int j, int k) { return shell(i, j, k) == 4 || shell(i, j, k) == 2; });
  TetMesh mesh = test::grid_mesh(9, [](int i, int j, int k) {
    const int depth = std::max({std::abs(i - 4), std::abs(j - 4), std::abs(k - 4)});
    return depth == 4 || depth == 2 ? 1 : kOutside;
  });
  Box box;
  for (const Point& p : mesh.vertices) box.extend(p);
  for (Point& p : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) p[axis] = 1 + (p[axis] - box.min[axis]) * 9 / (box.max[axis] - box.min[axis]);
  }
  const AuditReport report = audit_of(mesh, grid);
  EXPECT_EQ(report.cavities, 2U);
  EXPECT_TRUE(report.passed()) << report.findings.front().message;
}

TEST(AuditRegions, ACavityWhoseNodeIsAVertexWithinTheMeshIsMissing) {
  TetMesh mesh = box_without([](int, int, int) { return false; });
  const Vec to_node = Point{6, 6, 6} - mesh.vertices[mesh.vertices.size() / 2];
  for (Point& p : mesh.vertices) p = p + to_node;
  const RegionGrid grid =
      grid_where([](int i, int j, int k) { return in_box(i, j, k) && !(i == 6 && j == 6 && k == 6); });
  const AuditReport report = audit_of(mesh, grid);
  ASSERT_EQ(codes_of(report), std::vector<std::string>{"audit.cavity_missing"});
  EXPECT_EQ(report.findings[0].where, (Point{6, 6, 6}));
}

TEST(FindLosses, GivesAPlaceForEach) {
  const std::unique_ptr<Domain> no_curves = make_sphere({}, 1);
  const UniformSize size(1);
  const auto losses = [&](const TetMesh& mesh, const RegionGrid& grid) {
    return find_losses(mesh, *no_curves, grid, size).places;
  };
  const TetMesh whole = box_without([](int, int, int) { return false; });
  const TetMesh halves = box_without([](int i, int, int) { return i == 2; });
  EXPECT_TRUE(losses(whole, grid_where(in_box)).empty());
  EXPECT_EQ(losses(halves, grid_where(in_box)), (std::vector<Point>{{6.5, 2, 2}}));
  const RegionGrid two_cavities =
      grid_where([](int i, int j, int k) { return in_box(i, j, k) && !(j == 5 && k == 5 && (i == 4 || i == 7)); });
  EXPECT_EQ(losses(whole, two_cavities), (std::vector<Point>{{4, 5, 5}, {7, 5, 5}}));
  TetMesh broken = whole;
  broken.tets[0][0] = 1'000'000;
  EXPECT_TRUE(losses(broken, two_cavities).empty());
}

TEST(AuditRegions, FindingsHavePlaces) {
  const TetMesh whole = box_without([](int, int, int) { return false; });
  const RegionGrid grid = grid_where([](int i, int j, int k) {
    return in_box(i, j, k) && i % 2 == 0 && j % 2 == 0 && k % 2 == 0;  // 64 voxels that do not touch
  });
  const AuditReport report = audit_of(whole, grid);
  ASSERT_FALSE(report.findings.empty());
  for (const Finding& finding : report.findings) {
    EXPECT_EQ(finding.places.size(), std::min<std::uint64_t>(finding.count, 1000)) << finding.code;
    EXPECT_EQ(finding.places.front(), finding.where);
  }
}

TEST(AuditRegions, AreasAreThoseOfTheFacets) {
  const AuditReport report = audit_of(halved_box({}), two_halves(0, {}));
  double between = 0;
  double outer = 0;
  for (const MeshInterface& shared : report.interfaces) {
    (shared.regions[0] == kOutside || shared.regions[1] == kOutside ? outer : between) += shared.area_mm2;
  }
  EXPECT_NEAR(between, 64, 1e-9);
  EXPECT_NEAR(outer, 6 * 64, 1e-9);
}

}  // namespace
}  // namespace scantet
