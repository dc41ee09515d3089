#include "scantet/check/conformance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scantet/base/mesh_topology.h"
#include "scantet/base/parallel.h"
#include "scantet/domain/analytic.h"
#include "scantet/quality/measures.h"
#include "scantet/refine/mesher.h"

namespace scantet {
namespace {

/// A regular tet inscribed in the unit sphere: circumradius 1, radius-edge ratio √6/4 = 0.612; facets of circumradius
/// √8/3 = 0.943 and radius-edge ratio 0.577, whose surface balls are 2/3 away and have radius √(4/3) = 1.155.
class InscribedTet : public testing::Test {
 protected:
  InscribedTet() {
    const double s = 1 / std::sqrt(3.0);
    mesh_.vertices = {{s, s, s}, {-s, s, -s}, {s, -s, -s}, {-s, -s, s}};
    mesh_.tets = {{0, 1, 2, 3}};
    if (orientation_mm3(mesh_.vertices[0], mesh_.vertices[1], mesh_.vertices[2], mesh_.vertices[3]) < 0) {
      std::swap(mesh_.tets[0][2], mesh_.tets[0][3]);
    }
    mesh_.tet_regions = {1};
    build_boundary(mesh_);
  }

  Conformance check(double size_mm, const RuleBounds& rules) const {
    const UniformSize size(size_mm);
    return check_conformance(mesh_, *sphere_, {0, 180, 0, RuleTarget{rules, &size}});
  }
  Conformance check_shape(double min_dihedral_deg, double max_dihedral_deg, double min_scaled_jacobian) const {
    return check_conformance(mesh_, *sphere_, {min_dihedral_deg, max_dihedral_deg, min_scaled_jacobian, {}});
  }

  std::unique_ptr<Domain> sphere_ = make_sphere({0, 0, 0}, 1);
  TetMesh mesh_;
};

TEST_F(InscribedTet, AllRulesHold) {
  const Conformance c = check(1.2, {});
  EXPECT_TRUE(c.holds());
  EXPECT_EQ(c.facets, 4U);
  EXPECT_EQ(c.tets, 1U);
}

TEST_F(InscribedTet, BoundsThatAreMetExactlyAreMet) {
  const double facet_ratio = 1 / std::sqrt(3.0);
  EXPECT_TRUE(check(1, {std::sqrt(4.0 / 3), facet_ratio, std::sqrt(6.0) / 4, 2.0 / 3}).holds());
}

// Its edges are √(8/3) = 1.633 long.
TEST_F(InscribedTet, ShortEdges) {
  const UniformSize size(4);
  const double edge = std::sqrt(8.0 / 3);
  ElementBounds bounds{0, 180, 0, {}};
  bounds.min_edge = EdgeTarget{2, 0, nullptr, true};
  const Conformance in_mm = check_conformance(mesh_, *sphere_, bounds);
  EXPECT_FALSE(in_mm.holds());
  EXPECT_TRUE(in_mm.places.empty()) << "no element is at fault";
  EXPECT_EQ(in_mm.min_edge.count, 6U);
  EXPECT_NEAR(in_mm.min_edge.worst, edge, 1e-12);
  bounds.min_edge = EdgeTarget{0, 0.5, &size, true};
  const Conformance shares = check_conformance(mesh_, *sphere_, bounds);
  EXPECT_EQ(shares.min_edge.count, 6U);
  EXPECT_NEAR(shares.min_edge.worst, edge / 4, 1e-12) << "of the size";
  std::uint64_t edges = 0;
  for (const ShortEdgePlace& place : shares.short_edges) {
    EXPECT_NEAR(place.length_mm, edge, 1e-12);
    edges += place.edges;
  }
  EXPECT_EQ(edges, 6U);
  EXPECT_EQ(shares.min_edge.place, shares.short_edges.front().place);
  bounds.min_edge = EdgeTarget{1.6, 0, nullptr, true};
  EXPECT_TRUE(check_conformance(mesh_, *sphere_, bounds).holds());
}

TEST_F(InscribedTet, FacetShape) {
  const Conformance c = check(1.2, {1, 0.57, 2, std::nullopt});
  EXPECT_EQ(c.unmet, (UnmetRules{4, 0, 0}));
  EXPECT_EQ(c.facet_radius_edge.count, 4U);
  EXPECT_NEAR(c.facet_radius_edge.worst, 1 / std::sqrt(3.0), 1e-8);
  EXPECT_NEAR(length(c.facet_radius_edge.place), 1.0 / 3, 1e-12);
  EXPECT_EQ(c.places.size(), 4U);
  EXPECT_EQ(c.edges_mm.size(), 4U);
}

TEST_F(InscribedTet, BallTooLarge) {
  const Conformance c = check(1.2, {0.9, 1, 2, std::nullopt});
  EXPECT_EQ(c.unmet, (UnmetRules{0, 4, 0}));
  EXPECT_NEAR(c.facet_size.worst, std::sqrt(4.0 / 3) / 1.08, 1e-8);
}

TEST_F(InscribedTet, BallNowhereNear) {
  const Conformance c = check(1.2, {0.5, 1, 2, std::nullopt});
  EXPECT_EQ(c.unmet, (UnmetRules{0, 4, 0}));
  EXPECT_TRUE(std::isinf(c.facet_size.worst));
}

TEST_F(InscribedTet, BallTooFarFromItsFacet) {
  EXPECT_TRUE(check(1.2, {1, 1, 2, 0.67}).holds());
  const Conformance c = check(1.2, {1, 1, 2, 0.66});
  EXPECT_EQ(c.unmet, (UnmetRules{0, 4, 0}));
  EXPECT_NEAR(c.facet_distance.worst, 2.0 / 3, 1e-8);
}

TEST_F(InscribedTet, TetTooLarge) {
  const Conformance c = check(0.99, {2, 1, 2, std::nullopt});
  EXPECT_EQ(c.unmet, (UnmetRules{0, 0, 1}));
  EXPECT_NEAR(c.tet_size.worst, 1 / 0.99, 1e-8);
  EXPECT_EQ(c.places, std::vector{c.tet_size.place});
  ASSERT_EQ(c.edges_mm.size(), 1U);
  EXPECT_NEAR(c.edges_mm[0], std::sqrt(8.0 / 3), 1e-12);
}

TEST_F(InscribedTet, TetShape) {
  const Conformance c = check(1.2, {1, 1, 0.61, std::nullopt});
  EXPECT_EQ(c.unmet, (UnmetRules{0, 0, 1}));
  EXPECT_NEAR(c.tet_radius_edge.worst, std::sqrt(6.0) / 4, 1e-8);
}

TEST_F(InscribedTet, DihedralAngles) {
  mesh_.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 0.05}};  // near 7°, 9° and 164°
  mesh_.tets = {{0, 1, 2, 3}};
  build_boundary(mesh_);
  const auto angles = measure_tet(mesh_.vertices[0], mesh_.vertices[1], mesh_.vertices[2], mesh_.vertices[3]);
  const auto [smallest, largest] = std::minmax_element(angles.dihedral_deg.begin(), angles.dihedral_deg.end());
  EXPECT_TRUE(check_shape(*smallest - 0.01, *largest + 0.01, 0).holds());
  const Conformance c = check_shape(10, 150, 0);
  EXPECT_EQ(c.min_dihedral.count, 1U);
  EXPECT_NEAR(c.min_dihedral.worst, *smallest, 1e-5);
  EXPECT_EQ(c.max_dihedral.count, 1U);
  EXPECT_NEAR(c.max_dihedral.worst, *largest, 1e-5);
  EXPECT_EQ(c.places.size(), 1U);
}

// Of a needle smaller elements are of use where it is long.
TEST_F(InscribedTet, NeedlesAreAtTheirFarVertices) {
  mesh_.vertices = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0.03, 0.03, 1}};
  mesh_.tets = {{0, 1, 2, 3}};
  build_boundary(mesh_);
  const Conformance c = check_shape(0, 180, 0.1);
  ASSERT_EQ(c.scaled_jacobian.count, 1U);
  EXPECT_EQ(c.places, std::vector{mesh_.vertices[3]});
  EXPECT_EQ(c.edges_mm, std::vector{distance(mesh_.vertices[1], mesh_.vertices[3])});
  EXPECT_NE(c.scaled_jacobian.place, mesh_.vertices[3]);
}

TEST_F(InscribedTet, ScaledJacobian) {
  EXPECT_TRUE(check_shape(0, 180, 0.9).holds());
  mesh_.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh_.tets = {{0, 1, 2, 3}};
  build_boundary(mesh_);
  // Six volumes are 1; three edges of length √2 and √2, √2, 1 meet at a corner.
  EXPECT_TRUE(check_shape(0, 180, 0.7).holds());
  const Conformance c = check_shape(0, 180, 0.71);
  EXPECT_EQ(c.scaled_jacobian.count, 1U);
  EXPECT_NEAR(c.scaled_jacobian.worst, std::sqrt(0.5), 1e-8);
}

TEST_F(InscribedTet, DegenerateElementsBreakEveryBound) {
  mesh_.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  const UniformSize size(1.2);
  const Conformance c = check_conformance(mesh_, *sphere_, {1, 170, 0.01, RuleTarget{{}, &size}});
  EXPECT_EQ(c.unmet, (UnmetRules{4, 4, 1}));
  EXPECT_EQ(c.min_dihedral.count + c.max_dihedral.count + c.scaled_jacobian.count, 3U);
  EXPECT_EQ(c.min_dihedral.worst, 0);
  EXPECT_EQ(c.max_dihedral.worst, 180);
  EXPECT_TRUE(std::isinf(c.tet_radius_edge.worst));
  EXPECT_TRUE(std::isinf(c.facet_distance.worst)) << "which is not asked for";
  EXPECT_EQ(c, Conformance(c));
}

TEST_F(InscribedTet, EmptyMesh) {
  EXPECT_EQ(check_conformance({}, *sphere_, {}), Conformance{});
}

TEST(ConformanceOfAMesh, HoldsAfterRefinementAndFailsForStricterRules) {
  const auto sphere = make_sphere({1, 2, 3}, 5);
  const UniformSize size(1.2);
  Progress progress;
  const TetMesh mesh = mesh_domain(*sphere, size, {}, progress).mesh;
  ASSERT_GT(mesh.boundary_facets.size(), 300U);
  EXPECT_TRUE(check_conformance(mesh, *sphere, {0, 180, 0, RuleTarget{{}, &size}}).holds());

  const UniformSize smaller(0.8);
  const ElementBounds bounds{10, 160, 0.1, RuleTarget{{1, 0.7, 1, 0.01, 1}, &smaller}};
  const Conformance strict = check_conformance(mesh, *sphere, bounds);
  EXPECT_GT(strict.unmet.r1, 0U);
  EXPECT_LT(strict.unmet.r1, strict.facets);
  EXPECT_GT(strict.unmet.r2, strict.facets / 2);
  EXPECT_GT(strict.unmet.r3, strict.tets / 2);
  EXPECT_GT(strict.min_dihedral.count, 0U);
  for (const std::size_t threads : {1, 2, 3}) {
    with_threads(threads, [&] { EXPECT_EQ(check_conformance(mesh, *sphere, bounds), strict); });
  }
}

}  // namespace
}  // namespace scantet
