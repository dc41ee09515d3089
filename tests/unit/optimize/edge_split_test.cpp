#include <gtest/gtest.h>

#include "scantet/optimize/edge_split_impl.h"
#include "unit/optimize/operations.h"

namespace scantet::optimize {
namespace {

class EdgeSplitOf : public Operations {};

TEST_F(EdgeSplitOf, EdgesAddsAVertex) {
  EdgeSplit split(complex_, static_cast<VertexId>(complex_.vertex_slots()));
  EXPECT_EQ(expect_good_changes(100,
                                [&](TetId t, Change& best) {
                                  for_each_edge(complex_.tet(t),
                                                [&](VertexId a, VertexId b) { split.try_edge(a, b, best); });
                                  EXPECT_EQ(best.vertex, best.found() ? kNewVertex : kNoVertex);
                                }),
            100);
}

// A split that is one vertex away from another must reach the bound, which is out of reach here.
TEST_F(EdgeSplitOf, EdgesAtNewVerticesStops) {
  EdgeSplit split(complex_, 0);
  EXPECT_EQ(expect_good_changes(1,
                                [&](TetId t, Change& best) {
                                  for_each_edge(complex_.tet(t),
                                                [&](VertexId a, VertexId b) { split.try_edge(a, b, best); });
                                }),
            0);
}

TEST_F(EdgeSplitOf, EdgesWhereAllIsWorseFindsNothing) {
  EdgeSplit split(complex_, static_cast<VertexId>(complex_.vertex_slots()));
  expect_nothing_better_than_the_best([&](TetId t, Change& best) {
    for_each_edge(complex_.tet(t), [&](VertexId a, VertexId b) { split.try_edge(a, b, best); });
  });
}

TEST(EdgeSplit, PassesOverBoundaryEdges) {
  const TetMesh mesh = octahedron_with_sliver(1);
  const TetComplex complex(mesh);
  EdgeSplit split(complex, 6);
  for (const Triangle& f : mesh.boundary_facets) {
    for (std::size_t i = 0; i < 3; ++i) {
      Change best;
      split.try_edge(f[i], f[(i + 1) % 3], best);
      EXPECT_FALSE(best.found());
    }
  }
  Change best;
  split.try_edge(0, 2, best);
  EXPECT_EQ(best.vertex, kNewVertex);
  EXPECT_EQ(best.added.size(), 2 * best.removed.size());
}

}  // namespace
}  // namespace scantet::optimize
