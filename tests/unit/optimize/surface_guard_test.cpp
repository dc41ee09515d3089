#include <gtest/gtest.h>

#include "scantet/base/mesh_topology.h"
#include "scantet/optimize/surface_guard_impl.h"
#include "unit/optimize/test_meshes.h"

namespace scantet::optimize {
namespace {

class OnionGuard : public testing::Test {
 protected:
  /// A vertex on the sphere of that radius.
  VertexId vertex_at(double radius) const {
    VertexId v = 0;
    while (std::abs(length(mesh_.vertices[v]) - radius) > 1e-6) ++v;
    return v;
  }

  Onion domain_;
  TetMesh mesh_ = refined(domain_, 0.8);
  TetComplex complex_{mesh_};
  SurfaceGuard guard_{complex_, domain_, 0};
  Fan fan_;
};

TEST_F(OnionGuard, FindsTheFansOfAllVertices) {
  std::size_t facets = 0;
  for (VertexId v = 0; v < complex_.vertex_slots(); ++v) {
    const Freedom freedom = guard_.freedom(v, fan_);
    ASSERT_EQ(freedom, complex_.on_boundary(v) ? Freedom::on_surface : Freedom::inside);
    if (freedom != Freedom::on_surface) continue;
    facets += fan_.rim.size();
    const bool inner = length(complex_.point(v)) < 3;
    EXPECT_EQ(fan_.behind, 1);
    EXPECT_EQ(fan_.front, inner ? 2 : kOutside);
    // Normals point into the region in front: towards the origin on the inner sphere.
    const Facets of_fan = guard_.facets(v, fan_);
    for (const Corners& facet : of_fan.all()) {
      EXPECT_EQ(dot(facet_normal(facet), facet[0]) > 0, !inner);
    }
  }
  EXPECT_EQ(facets, 3 * mesh_.boundary_facets.size());
}

TEST_F(OnionGuard, FindsTheNeighboursOnTheBoundary) {
  for (const double radius : {Onion::kInner, Onion::kOuter}) {
    const VertexId v = vertex_at(radius);
    ASSERT_EQ(guard_.freedom(v, fan_), Freedom::on_surface);
    std::vector<VertexId> rim = fan_.rim;
    std::sort(rim.begin(), rim.end());
    EXPECT_EQ(guard_.boundary_neighbours(v), rim);
  }
  VertexId inside = 0;
  while (complex_.on_boundary(inside)) ++inside;
  EXPECT_TRUE(guard_.boundary_neighbours(inside).empty());
}

TEST(Facets, PutsThoseThatTouchCurvesLast) {
  const auto facet = [](double x) { return Corners{Point{x, 0, 0}, Point{x, 1, 0}, Point{x, 0, 1}}; };
  Facets facets;
  facets.add(facet(1), false);
  facets.add(facet(2), true);
  facets.add(facet(3), false);
  facets.add(facet(4), true);
  Facets more;
  more.add(facet(5), true);
  more.add(facet(6), false);
  facets.add(more);
  std::vector<double> order;
  for (const Corners& f : facets.all()) order.push_back(f[0].x);
  EXPECT_EQ(order, (std::vector<double>{1, 3, 6, 2, 4, 5}));
  EXPECT_EQ(facets.asked().size(), 3U);
  facets.clear();
  EXPECT_TRUE(facets.all().empty());
  EXPECT_TRUE(facets.asked().empty());
}

TEST_F(OnionGuard, FindsTheNearestPointOfTheRightSurface) {
  ASSERT_EQ(guard_.freedom(vertex_at(Onion::kOuter), fan_), Freedom::on_surface);
  const std::optional<Point> outer = guard_.nearest({0, 0, 3.5}, {0, 0, 3}, fan_);
  ASSERT_TRUE(outer);
  EXPECT_NEAR(distance(*outer, {0, 0, 4}), 0, 1e-12);
  EXPECT_FALSE(guard_.nearest({0, 0, 3.5}, {0, 0, 0.4}, fan_));
  EXPECT_FALSE(guard_.nearest({0, 0, 3.5}, {0, 0, -3}, fan_));  // from in front to behind
  ASSERT_EQ(guard_.freedom(vertex_at(Onion::kInner), fan_), Freedom::on_surface);
  const std::optional<Point> inner = guard_.nearest({0, 0, 3.5}, {0, 0, -3}, fan_);
  ASSERT_TRUE(inner);
  EXPECT_NEAR(distance(*inner, {0, 0, 2}), 0, 1e-12);
}

TEST_F(OnionGuard, LetsFacetsBeReplacedByNearOnesOnly) {
  const VertexId v = vertex_at(Onion::kOuter);
  ASSERT_EQ(guard_.freedom(v, fan_), Freedom::on_surface);
  const Facets old_facets = guard_.facets(v, fan_);
  const auto moved = [&](const Vec& by) {
    Facets facets = old_facets;
    for (Corners& facet : facets.all()) facet[0] = facet[0] + by;
    return facets;
  };
  const Vec normal = (1 / length(complex_.point(v))) * complex_.point(v);
  EXPECT_EQ(guard_.rate_replacement(old_facets, old_facets, fan_), kNoFacets) << "nothing is asked of facets";
  EXPECT_EQ(guard_.rate_replacement(old_facets, moved(0.2 * normal), fan_), kInverted);
  EXPECT_EQ(guard_.rate_replacement(old_facets, moved(-0.2 * normal), fan_), kInverted);
  SurfaceGuard tolerant(complex_, domain_, 0.3);
  EXPECT_EQ(tolerant.rate_replacement(old_facets, moved(0.2 * normal), fan_), kNoFacets);
  // Over the rim: facets fold.
  EXPECT_EQ(tolerant.rate_replacement(old_facets, moved(1.5 * (complex_.point(fan_.rim[0]) - complex_.point(v))), fan_),
            kInverted);
}

TEST_F(OnionGuard, KnowsHowFarFacetsAreFromTheSurface) {
  const double typical = typical_distance_mm(complex_, domain_);
  double farthest = 0;
  for (const Triangle& f : mesh_.boundary_facets) {
    const Point middle = (1.0 / 3) * (mesh_.vertices[f[0]] + mesh_.vertices[f[1]] + mesh_.vertices[f[2]]);
    farthest = std::max(farthest, *domain_.residual_at(middle) * Onion::kOuter);
  }
  EXPECT_GT(typical, 0.2 * farthest);
  EXPECT_LT(typical, farthest);
}

TEST(SurfaceGuard, KeepsVerticesWhereThreeRegionsMeet) {
  const auto torus = make_torus({1, 2, 3}, 5, 2);
  const TetComplex complex(two_halves(refined(*torus, 1)));
  SurfaceGuard guard(complex, *torus, 0);
  std::size_t kept = 0;
  Fan fan;
  for (VertexId v = 0; v < complex.vertex_slots(); ++v) {
    bool in_one = false;
    bool in_two = false;
    for (const TetId t : complex.star(v)) (complex.region(t) == 1 ? in_one : in_two) = true;
    const bool at_outside = torus->residual_at(complex.point(v)) < 1e-9;
    const Freedom freedom = guard.freedom(v, fan);
    if (in_one && in_two && at_outside) {
      EXPECT_EQ(freedom, Freedom::none);
      ++kept;
    }
    if (in_one && in_two) continue;
    EXPECT_EQ(freedom, at_outside ? Freedom::on_surface : Freedom::inside);
  }
  EXPECT_GT(kept, 20U);
}

/// A tet as a hollow, with a tet on each of its faces.
TetMesh around_a_hollow() {
  TetMesh mesh;
  mesh.vertices = {{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}};
  const Tet hollow{0, 1, 2, 3};
  for (int k = 0; k < 4; ++k) {
    const auto v = static_cast<VertexId>(mesh.vertices.size());
    mesh.vertices.push_back(-2 * mesh.vertices[hollow[static_cast<std::size_t>(k)]]);
    const Triangle face = face_of(hollow, k);
    mesh.tets.push_back({v, face[2], face[1], face[0]});
    const auto& p = mesh.vertices;
    if (orientation_mm3(p[v], p[face[2]], p[face[1]], p[face[0]]) < 0)
      std::swap(mesh.tets.back()[2], mesh.tets.back()[3]);
  }
  mesh.tet_regions.assign(4, 1);
  build_boundary(mesh);
  return mesh;
}

TEST(SurfaceGuard, FindsTheLidsOfHollowsOfFourFacets) {
  const auto sphere = make_sphere({}, 5);
  TetMesh mesh = around_a_hollow();
  const TetComplex complex(mesh);
  const SurfaceGuard guard(complex, *sphere, 1);
  for (VertexId v = 0; v < 4; ++v) {
    std::vector<VertexId> rim{0, 1, 2, 3};
    rim.erase(rim.begin() + v);
    const std::optional<Lid> lid = guard.lid_of(rim, {v});
    ASSERT_TRUE(lid);
    const Point& p = complex.point(v);
    EXPECT_EQ(lid->behind, -2 * p);
    EXPECT_FALSE(lid->turns_over(p));
    EXPECT_FALSE(lid->turns_over(-0.3 * p)) << "the lid is a third as far from the middle";
    EXPECT_TRUE(lid->turns_over(-0.4 * p));
    EXPECT_FALSE(guard.lid_of(rim, {v, static_cast<VertexId>(v + 4)})) << "nothing is behind";
    EXPECT_FALSE(guard.lid_of(std::span(rim).first(2), {v}));
  }
  mesh.tets.push_back({0, 1, 2, 3});
  if (orientation_mm3(mesh.vertices[0], mesh.vertices[1], mesh.vertices[2], mesh.vertices[3]) < 0) {
    std::swap(mesh.tets.back()[2], mesh.tets.back()[3]);
  }
  mesh.tet_regions.push_back(1);
  build_boundary(mesh);
  const TetComplex filled(mesh);
  EXPECT_FALSE(SurfaceGuard(filled, *sphere, 1).lid_of(std::vector<VertexId>{1, 2, 3}, {0})) << "no hollow";
}

}  // namespace
}  // namespace scantet::optimize
