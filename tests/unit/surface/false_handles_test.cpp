// A ball through which a tunnel is cut, and a ring, whose handle is its own.
#include <algorithm>
#include <cmath>
#include <functional>

#include "scantet/domain/analytic.h"
#include "scantet/surface/boundary_facets_impl.h"
#include "scantet/surface/false_handles_impl.h"
#include "unit/surface/samples.h"

namespace scantet::engine {
namespace {

constexpr double kRadius = 4;

TriangleSurface boundary_of(const Triangulation& t) {
  TriangleSurface surface;
  for (PointId v = 0; v < t.vertex_slots(); ++v) surface.vertices.push_back(t.point(v));
  for (const FacetCode facet : boundary_facets(t)) {
    surface.facets.push_back(facet_vertices(t.cell(facet / 4), static_cast<int>(facet % 4)));
  }
  return surface;
}

/// With points in it, too.
RestrictedTriangulation filled(const Domain& domain, double spacing_mm) {
  std::vector<SamplePoint> sample = sparse_sample(domain, spacing_mm, 1);
  for (int i = 0; i < 1331; ++i) {
    const Point p{0.81 * (i % 11 - 5), 0.83 * (i / 11 % 11 - 5), 0.79 * (i / 121 - 5)};
    if (length(p - Point{}) < kRadius - 0.6) sample.push_back({p, 3});
  }
  return triangulated(domain, std::move(sample));
}

bool is_in_tunnel(const Point& p) {
  return std::hypot(p.x, p.y) < 1;
}

TEST(FalseHandles, ATunnelThatTheDomainHasNotIsOne) {
  const std::unique_ptr<Domain> ball = make_sphere({}, kRadius);
  RestrictedTriangulation restricted = filled(*ball, 0.8);
  const UniformSize size(6);
  EXPECT_TRUE(
      false_handles(boundary_of(restricted.triangulation()), 1, restricted.triangulation(), *ball, size).empty());
  turn(restricted, 1, is_in_tunnel);
  const TriangleSurface boundary = boundary_of(restricted.triangulation());
  const std::vector<Misplaced> places = false_handles(boundary, 1, restricted.triangulation(), *ball, size);
  ASSERT_FALSE(places.empty());
  for (const Misplaced& place : places) {
    EXPECT_EQ(place.region, 1U);
    EXPECT_LT(std::hypot(place.point.x, place.point.y), 2);
  }
  EXPECT_TRUE(false_handles(boundary, 1, restricted.triangulation(), *ball, UniformSize(0.5)).empty())
      << "no path that short leads around it";
}

TEST(FalseHandles, EachHasAPlaceThoughTheMiddleOfItsDiskIsRight) {
  constexpr double kHollow = 0.3;
  const std::unique_ptr<Domain> ball = make_sphere({}, kRadius);
  RestrictedTriangulation restricted = filled(*ball, 0.8);
  turn(restricted, 1, [](const Point& p) { return std::hypot(p.x, p.y) < 0.6; });
  const TriangleSurface boundary = boundary_of(restricted.triangulation());
  const auto places_in = [&](const Domain& domain) {
    return false_handles(boundary, 1, restricted.triangulation(), domain, UniformSize(10));
  };
  const std::vector<Misplaced> in_ball = places_in(*ball);
  ASSERT_FALSE(in_ball.empty());
  for (const Misplaced& place : in_ball) {
    const std::vector<Misplaced> places = places_in(*make_shell(place.point, kHollow, 2 * kRadius));
    ASSERT_FALSE(places.empty());
    for (std::size_t i = 0; i < places.size(); ++i) {
      EXPECT_EQ(places[i].region, 1U);
      const std::uint32_t last = i == 0 ? 0 : places[i - 1].group;
      EXPECT_LE(places[i].group, last + (i == 0 ? 0 : 1)) << "none is left out";
    }
  }
}

TEST(FalseHandles, TheRingHasNone) {
  const std::unique_ptr<Domain> ring = make_torus({}, 3, 1);
  RestrictedTriangulation restricted = triangulated(*ring, sparse_sample(*ring, 0.5, 1));
  const UniformSize size(20);
  EXPECT_TRUE(
      false_handles(boundary_of(restricted.triangulation()), 1, restricted.triangulation(), *ring, size).empty())
      << "the ring's own handle";
}

TEST(FalseHandles, ABridgeThatTheDomainHasNotIsOne) {
  const std::unique_ptr<Domain> ring = make_torus({}, 3, 1);
  RestrictedTriangulation restricted = triangulated(*ring, sparse_sample(*ring, 0.5, 1));
  turn(restricted, kOutside,
       [](const Point& p) { return std::abs(p.x) < 0.9 && std::abs(p.y) < 2.5 && std::abs(p.z) < 0.9; });
  const std::vector<Misplaced> places =
      false_handles(boundary_of(restricted.triangulation()), 1, restricted.triangulation(), *ring, UniformSize(20));
  ASSERT_FALSE(places.empty());
  const auto is_in_bridge = [](const Misplaced& p) { return p.region == kOutside && std::abs(p.point.x) < 1; };
  EXPECT_TRUE(std::any_of(places.begin(), places.end(), is_in_bridge));
}

}  // namespace
}  // namespace scantet::engine
