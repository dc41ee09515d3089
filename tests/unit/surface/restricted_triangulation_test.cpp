// The restrictions that editing keeps up to date, against the domain asked anew for every cell and facet.
#include <random>

#include "scantet/domain/analytic.h"
#include "scantet/surface/restricted_triangulation_impl.h"
#include "unit/nested_balls.h"
#include "unit/surface/samples.h"

namespace scantet::engine {
namespace {

/// The chain of a facet's balls; both of its cells must name it.
std::vector<SurfaceBall> chain_of(const RestrictedTriangulation& t, FacetCode facet) {
  const FacetCode across = t.triangulation().cell(facet / 4).neighbor[facet % 4];
  const std::uint32_t head = t.triangulation().info(facet / 4).balls[facet % 4];
  EXPECT_EQ(t.triangulation().info(across / 4).balls[across % 4], head);
  std::vector<SurfaceBall> chain;
  for (std::uint32_t b = head; b != kNone; b = t.balls()[b].next) {
    EXPECT_EQ(t.balls()[b].generation % 2, 1U) << "in use";
    EXPECT_TRUE(t.balls()[b].facet == facet || t.balls()[b].facet == across);
    chain.push_back(t.balls()[b]);
  }
  return chain;
}

/// Expects each cell to be in the region of its circumcentre, and each facet to have a ball wherever its dual edge
/// crosses ∂O. Returns how many facets have several.
std::size_t expect_up_to_date(const RestrictedTriangulation& restricted, const Domain& domain) {
  const Triangulation& t = restricted.triangulation();
  for (CellId c = 0; c < t.cell_slots(); ++c) {
    if (!t.is_cell(c)) continue;
    EXPECT_EQ(t.info(c).region, t.has_corner(c) ? kOutside : domain.region_at(t.cell(c).circumcentre));
  }
  std::size_t in_chains = 0;
  std::size_t several = 0;
  Crossings crossings;
  for_each_inner_facet(t, [&](FacetCode facet) {
    const std::vector<SurfaceBall> chain = chain_of(restricted, facet);
    in_chains += chain.size();
    several += chain.size() > 1 ? 1 : 0;
    const FacetCode across = t.cell(facet / 4).neighbor[facet % 4];
    if (t.has_corner(facet / 4) || t.has_corner(across / 4)) return;  // those dual edges are cut off
    const Point& here = t.cell(facet / 4).circumcentre;
    const Point& there = t.cell(across / 4).circumcentre;
    const double far = 1.9 * length(domain.bounds().extent());
    if (distance(here, domain.bounds().center()) > far || distance(there, domain.bounds().center()) > far) return;
    domain.crossings(lexicographically_less(here, there) ? Segment{here, there} : Segment{there, here}, crossings);
    ASSERT_EQ(chain.size(), crossings.size());
    for (std::size_t i = 0; i < chain.size(); ++i) {
      EXPECT_EQ(chain[i].center, crossings[i].point);
      EXPECT_EQ(chain[i].patch, crossings[i].patch());
      for (const PointId v : facet_vertices(t.cell(facet / 4), static_cast<int>(facet % 4))) {
        EXPECT_NEAR(distance(chain[i].center, t.point(v)), chain[i].radius, 1e-6 * (1 + chain[i].radius));
      }
    }
  });
  std::size_t in_use = 0;
  for (std::uint32_t b = 0; b < restricted.balls().slots(); ++b) in_use += restricted.balls()[b].generation % 2;
  EXPECT_EQ(in_use, in_chains);
  return several;
}

TEST(RestrictedTriangulation, IsClassifiedWhenItIsBuilt) {
  const auto torus = make_torus({}, 5, 0.7);
  EXPECT_GT(expect_up_to_date(triangulated(*torus, sparse_sample(*torus, 0.6, 4)), *torus), 10U);
  const test::NestedBalls balls(3, 6);
  expect_up_to_date(triangulated(balls, sparse_sample(balls, 1, 1)), balls);
}

TEST(RestrictedTriangulation, PointsThatDoNotSpanSpaceAreRefused) {
  const auto sphere = make_sphere({}, 5);
  RestrictedTriangulation t(*sphere);
  Progress progress;
  EXPECT_FALSE(t.build({{{5, 0, 0}, 2}, {{0, 5, 0}, 2}, {{-5, 0, 0}, 2}, {{0, -5, 0}, 2}}, progress));
}

TEST(RestrictedTriangulation, VerticesKnowTheirPatch) {
  const auto spheres = make_two_spheres(5, 2);
  RestrictedTriangulation restricted = triangulated(*spheres, sparse_sample(*spheres, 2, 1));
  const Point added = lerp(restricted.triangulation().point(10), {0.3, 0.4, 0.5}, 0.5);  // off ∂O, as may be
  Editor editor(restricted);
  ASSERT_EQ(editor.find_zone(added, kNone), Inserter::Found::zone);
  const PointId inside = editor.insert({added, 3});
  editor.retire();
  const Triangulation& t = restricted.triangulation();
  for (PointId v = Triangulation::kCorners; v < t.vertex_slots(); ++v) {
    ASSERT_TRUE(t.is_vertex(v));
    if (v == inside) {
      EXPECT_FALSE(t.vertex_info(v).patch.is_known());
    } else {
      EXPECT_EQ(t.vertex_info(v).patch, spheres->patch_at(t.point(v)));
      EXPECT_TRUE(t.vertex_info(v).patch.is_known());
    }
  }
}

TEST(Editor, KeepsTheRestrictionsUpToDate) {
  const auto torus = make_torus({}, 5, 1);
  RestrictedTriangulation t = triangulated(*torus, sparse_sample(*torus, 0.8, 4));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-6, 6);
  for (PointId v = 0; v < t.triangulation().vertex_slots(); ++v) t.disks().set_disk(v, true);
  std::vector<std::pair<CellId, std::uint32_t>> gone;
  Editor editor(t);
  for (int i = 0; i < 300; ++i) {
    const Point p{coordinate(random), coordinate(random), 0.2 * coordinate(random)};
    ASSERT_EQ(editor.find_zone(p, kNone), Inserter::Found::zone);
    for (const CellId c : editor.zone().cells) gone.emplace_back(c, t.triangulation().info(c).generation);
    const PointId v = editor.insert({p, 3});
    for (const CellId c : editor.new_cells()) {
      for (const PointId corner : t.triangulation().cell(c).vertex) {
        EXPECT_FALSE(corner >= Triangulation::kCorners && t.disks().has_disk(corner));
      }
    }
    EXPECT_EQ(t.triangulation().point(v), p);
  }
  for (const auto& [c, generation] : gone) EXPECT_FALSE(t.cell_alive(c, generation));
  editor.retire();
  expect_up_to_date(t, *torus);
}

TEST(Editor, OfAPartHasSlotsForSoManyVertices) {
  const auto torus = make_torus({}, 5, 1);
  RestrictedTriangulation t = triangulated(*torus, sparse_sample(*torus, 0.8, 2));
  VertexParts parts(t.triangulation().vertex_slots() + 1000, 0);
  const std::uint64_t before = t.vertex_count();
  Editor editor(t, parts, 0, 200);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> coordinate(-6, 6);
  std::uint64_t inserted = 0;
  for (int i = 0; i < 1000; ++i) {
    const Point p{coordinate(random), coordinate(random), 0.2 * coordinate(random)};
    ASSERT_EQ(editor.find_zone(p, t.triangulation().vertex(Triangulation::kCorners).cell), Inserter::Found::zone);
    if (!editor.has_room()) break;
    editor.insert({p, 3});
    ++inserted;
  }
  editor.retire();
  EXPECT_EQ(inserted, 200U);
  EXPECT_EQ(t.vertex_count(), before + inserted);
  expect_up_to_date(t, *torus);
}

}  // namespace
}  // namespace scantet::engine
