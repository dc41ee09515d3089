// What the audit says of the interfaces between regions.
#include <gtest/gtest.h>

#include "scantet/check/audit.h"
#include "unit/quality/grid_mesh.h"

namespace scantet {
namespace {

using test::grid_mesh;

TEST(Audit, InterfacesAreListedByTheirRegions) {
  const AuditReport report = audit(grid_mesh(7,
                                             [](int i, int j, int k) {
                                               return i == 5 && j == 5 && k == 5   ? 2
                                                      : i == 2 && j == 2 && k == 2 ? 2
                                                      : i == 2 && j == 2 && k == 4 ? 3
                                                                                   : 1;
                                             }),
                                   nullptr);
  EXPECT_TRUE(report.passed());
  ASSERT_EQ(report.interfaces.size(), 3U);
  const auto expect = [&](std::size_t i, const std::array<Region, 2>& regions, std::uint64_t facets,
                          std::uint64_t surfaces) {
    EXPECT_EQ(report.interfaces[i].regions, regions);
    EXPECT_EQ(report.interfaces[i].facets, facets);
    EXPECT_EQ(report.interfaces[i].surfaces, surfaces);
    EXPECT_EQ(report.interfaces[i].euler, 2 * static_cast<std::int64_t>(surfaces));
    EXPECT_NEAR(report.interfaces[i].mean_angle_deg, 45, 1e-9) << "halves of squares";
    EXPECT_NEAR(report.interfaces[i].min_angle_deg, 45, 1e-9);
    EXPECT_NEAR(report.interfaces[i].mean_edge_mm, report.interfaces[i].min_edge_mm * 3.414213562373095 / 3, 1e-12);
  };
  expect(0, {1, 0}, std::uint64_t{2} * 6 * 49, 1);
  expect(1, {1, 2}, std::uint64_t{2} * 12, 2);
  expect(2, {1, 3}, 12, 1);
}

TEST(Audit, OneRegionHasOneInterface) {
  const AuditReport report = audit(grid_mesh(4), nullptr);
  ASSERT_EQ(report.interfaces.size(), 1U);
  EXPECT_EQ(report.interfaces[0].regions, (std::array<Region, 2>{1, 0}));
  EXPECT_EQ(report.interfaces[0].facets, 2U * 6 * 16);
  EXPECT_EQ(report.interfaces[0].surfaces, 1U);
  EXPECT_EQ(report.interfaces[0].euler, 2);
}

TEST(Audit, InterfacesThatTouchAtAVertexAreNoManifold) {
  // Region 2 reaches the outer surface of region 1 in one corner of a cube.
  const AuditReport report = audit(grid_mesh(4,
                                             [](int i, int j, int k) {
                                               if (i == 0 && j == 0 && k == 0) return kOutside;
                                               return i == 1 && j == 1 && k == 1 ? 2 : 1;
                                             }),
                                   nullptr);
  EXPECT_EQ(report.non_manifold_vertices, 1U);
  EXPECT_EQ(report.non_manifold_edges, 0U);
  ASSERT_EQ(report.findings.size(), 1U);
  EXPECT_EQ(report.findings[0].code, "audit.boundary_vertex");
}

TEST(Audit, FacetsMayBeListedFromEitherRegion) {
  TetMesh mesh = grid_mesh(2, [](int i, int, int) { return 1 + i; });
  for (std::size_t i = 0; i < mesh.boundary_facets.size(); ++i) {
    if (mesh.facet_regions[i][1] == kOutside) continue;
    std::swap(mesh.facet_regions[i][0], mesh.facet_regions[i][1]);
    std::swap(mesh.boundary_facets[i][0], mesh.boundary_facets[i][1]);
  }
  EXPECT_TRUE(audit(mesh, nullptr).passed());
}

}  // namespace
}  // namespace scantet
