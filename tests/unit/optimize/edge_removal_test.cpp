#include <gtest/gtest.h>

#include "scantet/optimize/edge_removal_impl.h"
#include "unit/cut_balls.h"
#include "unit/optimize/operations.h"
#include "unit/sharp_cube.h"

namespace scantet::optimize {
namespace {

class EdgeRemovalOf : public Operations {};

TEST_F(EdgeRemovalOf, InnerEdges) {
  EdgeRemoval removal(complex_, guard_);
  EXPECT_EQ(expect_good_changes(100,
                                [&](TetId t, Change& best) {
                                  for_each_edge(complex_.tet(t), [&](VertexId a, VertexId b) {
                                    removal.try_edge(a, b, EdgeKind::inner, best);
                                  });
                                  for (const NewTet& added : best.added) {
                                    EXPECT_EQ(added.region, complex_.region(best.removed.front()));
                                  }
                                }),
            100);
}

TEST_F(EdgeRemovalOf, BoundaryEdgesFlipsThem) {
  EdgeRemoval removal(complex_, guard_);
  EXPECT_GT(expect_good_changes(100,
                                [&](TetId t, Change& best) {
                                  for_each_edge(complex_.tet(t), [&](VertexId a, VertexId b) {
                                    removal.try_edge(a, b, EdgeKind::boundary, best);
                                  });
                                }),
            20);
}

/// Flips edges of the boundary that end at curves, and sees that the mesh is as good as before.
void expect_flips_at_curves(const Domain& domain, int most) {
  const TetMesh mesh = refined(domain, 1.5);
  const TetComplex complex(mesh);
  SurfaceGuard guard(complex, domain, 0.5);
  EdgeRemoval removal(complex, guard);
  int found = 0;
  for (TetId t = 0; t < complex.tet_slots() && found < most; ++t) {
    for_each_edge(complex.tet(t), [&](VertexId a, VertexId b) {
      Change change;
      change.reset(0.999);
      if (found == most || !complex.on_curve(a)) return;
      removal.try_edge(a, b, EdgeKind::boundary, change);
      if (!change.found()) return;
      ++found;
      EXPECT_FALSE(complex.is_sharp_edge(a, b));
      expect_good_beside_curves(mesh, change, domain);
    });
  }
  EXPECT_GT(found, most / 2);
}

TEST(EdgeRemoval, FlipsEdgesThatEndAtCurves) {
  for (const int cells : {2, 3, 4}) expect_flips_at_curves(test::CutBall(6, cells), 40);
}

TEST(EdgeRemoval, LeavesSharpEdgesAlone) {
  expect_flips_at_curves(test::SharpCube(8), 40);
}

TEST_F(EdgeRemovalOf, EdgesWhereAllIsWorseFindsNothing) {
  EdgeRemoval removal(complex_, guard_);
  expect_nothing_better_than_the_best([&](TetId t, Change& best) {
    for_each_edge(complex_.tet(t), [&](VertexId a, VertexId b) {
      removal.try_edge(a, b, EdgeKind::inner, best);
      removal.try_edge(a, b, EdgeKind::boundary, best);
    });
  });
}

TEST(EdgeRemoval, TakesTheSliverOutOfAnOctahedron) {
  const Onion domain;
  const TetMesh mesh = octahedron_with_sliver(1);
  const TetComplex complex(mesh, TetJudge({.min_dihedral_deg = 40}));
  SurfaceGuard guard(complex, domain, 0);
  Change best;
  EdgeRemoval(complex, guard).try_edge(0, 2, EdgeKind::inner, best);
  EXPECT_EQ(best.removed.size(), 3U);
  EXPECT_EQ(best.added.size(), 2U);
  EXPECT_EQ(best.sharpest, complex.judge().bound());
}

// Where the sliver is a region of its own, its edges lie on the boundary.
TEST(EdgeRemoval, KeepsTheBoundaryBetweenRegions) {
  const Onion domain;
  const TetMesh mesh = octahedron_with_sliver(2);
  const TetComplex complex(mesh, TetJudge({.min_dihedral_deg = 40}));
  SurfaceGuard guard(complex, domain, 0);
  Change best;
  for (const EdgeKind kind : {EdgeKind::inner, EdgeKind::boundary}) {
    EdgeRemoval(complex, guard).try_edge(0, 2, kind, best);
  }
  EXPECT_FALSE(best.found());
}

}  // namespace
}  // namespace scantet::optimize
