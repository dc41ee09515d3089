#include <gtest/gtest.h>

#include "scantet/optimize/contraction_impl.h"
#include "unit/cut_balls.h"
#include "unit/optimize/operations.h"

namespace scantet::optimize {
namespace {

class ContractionOf : public Operations {};

TEST_F(ContractionOf, EdgesTakesAVertexAway) {
  Contraction contraction(complex_, guard_);
  int on_boundary = 0;
  EXPECT_EQ(expect_good_changes(
                100,
                [&](TetId t, Change& best) {
                  for_each_edge(complex_.tet(t), [&](VertexId v, VertexId u) { contraction.try_edge(v, u, best); });
                  if (!best.found()) return;
                  // The vertex that goes is in all tets that go.
                  for (const VertexId v : complex_.tet(best.removed.front())) {
                    const auto has_it = [&](TetId r) { return has_vertex(complex_.tet(r), v); };
                    if (std::all_of(best.removed.begin(), best.removed.end(), has_it) && complex_.on_boundary(v)) {
                      ++on_boundary;
                    }
                  }
                }),
            100);
  EXPECT_GT(on_boundary, 10);
}

TEST_F(ContractionOf, EdgesMayMoveTheVertexThatStays) {
  Contraction contraction(complex_, guard_);
  int on_boundary = 0;
  EXPECT_EQ(expect_good_changes(60,
                                [&](TetId t, Change& best) {
                                  for_each_edge(complex_.tet(t), [&](VertexId v, VertexId u) {
                                    if (best.found()) return;
                                    contraction.try_edge_moving(v, u, best);
                                    if (best.found() && best.on_boundary) ++on_boundary;
                                  });
                                }),
            60);
  EXPECT_GT(on_boundary, 5);
}

TEST_F(ContractionOf, EdgesWhereAllIsWorseFindsNothing) {
  Contraction contraction(complex_, guard_);
  expect_nothing_better_than_the_best([&](TetId t, Change& best) {
    for_each_edge(complex_.tet(t), [&](VertexId v, VertexId u) { contraction.try_edge(v, u, best); });
  });
}

// A vertex of the boundary may not leave it: neither into the inside nor through it to another surface.
TEST_F(ContractionOf, BoundaryVerticesGoesAlongTheirSurface) {
  Contraction contraction(complex_, guard_);
  int tried = 0;
  for (TetId t = 0; t < complex_.tet_slots(); ++t) {
    for_each_edge(complex_.tet(t), [&](VertexId v, VertexId u) {
      const bool same = std::abs(length(complex_.point(v)) - length(complex_.point(u))) < 1e-6;
      if (!complex_.on_boundary(v) || (complex_.on_boundary(u) && same)) return;
      ++tried;
      Change best;
      best.reset(kAsked);
      contraction.try_edge(v, u, best);
      EXPECT_FALSE(best.found());
    });
  }
  EXPECT_GT(tried, 1000);
}

// Vertices of the surface go into those of curves, and no curve changes by it.
TEST(Contraction, TakesVerticesIntoCurves) {
  for (const int cells : {2, 3, 4}) {
    const test::CutBall domain(6, cells);
    const TetMesh mesh = refined(domain, 1.5);
    const TetComplex complex(mesh);
    SurfaceGuard guard(complex, domain, 0.5);
    Contraction contraction(complex, guard);
    int found = 0;
    for (TetId t = 0; t < complex.tet_slots() && found < 40; ++t) {
      for_each_edge(complex.tet(t), [&](VertexId v, VertexId u) {
        Change change;
        change.reset(0.999);
        if (found == 40 || !complex.on_curve(u) || !complex.on_boundary(v)) return;
        contraction.try_edge(v, u, change);
        if (!change.found()) return;
        ++found;
        EXPECT_FALSE(complex.on_curve(v));
        expect_good_beside_curves(mesh, change, domain);
      });
    }
    EXPECT_EQ(found, 40) << cells << " cells";
  }
}

// A component of one tet. The sphere is small enough for the guard to see it from all sides of all facets.
TEST(Contraction, KeepsATetThatIsAllThereIs) {
  const auto sphere = make_sphere({0, 0, 0}, 0.48);
  const double s = 1 / std::sqrt(3.0);
  TetMesh mesh;
  mesh.vertices = {{s, s, s}, {-s, s, -s}, {s, -s, -s}, {-s, -s, s}};
  mesh.tets = {{0, 1, 2, 3}};
  mesh.tet_regions = {1};
  build_boundary(mesh);
  const TetComplex complex(mesh);
  ASSERT_LT(complex.sharpness(mesh.tets[0]), 1);
  SurfaceGuard guard(complex, *sphere, 1);
  Change best;
  for_each_edge(mesh.tets[0], [&](VertexId v, VertexId u) { Contraction(complex, guard).try_edge(v, u, best); });
  EXPECT_FALSE(best.found());
}

}  // namespace
}  // namespace scantet::optimize
