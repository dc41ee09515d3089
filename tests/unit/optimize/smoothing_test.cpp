#include <gtest/gtest.h>

#include "scantet/optimize/smoothing_impl.h"
#include "unit/optimize/operations.h"

namespace scantet::optimize {
namespace {

class SmoothingOf : public Operations {};

TEST_F(SmoothingOf, VerticesMovesThem) {
  Smoothing smoothing(complex_, guard_);
  int on_boundary = 0;
  EXPECT_EQ(expect_good_changes(100,
                                [&](TetId t, Change& best) {
                                  for (const VertexId v : complex_.tet(t)) smoothing.try_vertex(v, best);
                                  if (best.found()) on_boundary += best.on_boundary ? 1 : 0;
                                }),
            100);
  EXPECT_GT(on_boundary, 10);
}

TEST_F(SmoothingOf, VerticesWhereAllIsWorseFindsNothing) {
  Smoothing smoothing(complex_, guard_);
  expect_nothing_better_than_the_best([&](TetId t, Change& best) {
    for (const VertexId v : complex_.tet(t)) smoothing.try_vertex(v, best);
  });
}

TEST_F(SmoothingOf, BoundaryVerticesKeepsThemOnTheirSphere) {
  Smoothing smoothing(complex_, guard_);
  int moved = 0;
  for (VertexId v = 0; v < complex_.vertex_slots(); ++v) {
    if (!complex_.on_boundary(v)) continue;
    Change best;
    best.reset(kAsked);
    smoothing.try_vertex(v, best);
    if (!best.found()) continue;
    moved += best.position != complex_.point(v) ? 1 : 0;
    EXPECT_TRUE(best.on_boundary);
    EXPECT_NEAR(length(best.position), length(complex_.point(v)), 1e-9);
  }
  EXPECT_GT(moved, 100);
}

}  // namespace
}  // namespace scantet::optimize
