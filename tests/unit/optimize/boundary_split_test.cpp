#include <gtest/gtest.h>

#include "scantet/optimize/boundary_split_impl.h"
#include "unit/optimize/operations.h"

namespace scantet::optimize {
namespace {

class BoundarySplitOf : public Operations {
 protected:
  /// Tries the edges of boundary faces.
  void try_faces(BoundarySplit& split, TetId t, Change& best) const {
    for (int k = 0; k < 4; ++k) {
      if (!complex_.is_boundary_face(t, k)) continue;
      const Triangle face = face_of(complex_.tet(t), k);
      for (std::size_t i = 0; i < 3; ++i) split.try_edge(face[i], face[(i + 1) % 3], best);
    }
  }
};

TEST_F(BoundarySplitOf, EdgesPutsAVertexOnTheSurface) {
  BoundarySplit split(complex_, guard_, static_cast<VertexId>(complex_.vertex_slots()));
  int between_regions = 0;
  const int found = expect_good_changes(100, [&](TetId t, Change& best) {
    try_faces(split, t, best);
    if (!best.found()) return;
    EXPECT_EQ(best.vertex, kNewVertex);
    EXPECT_TRUE(best.on_boundary);
    EXPECT_EQ(best.added.size(), 2 * best.removed.size());
    const double radius = length(best.position);
    EXPECT_LT(std::min(std::abs(radius - Onion::kInner), std::abs(radius - Onion::kOuter)), 1e-9);
    const auto is_other = [&](TetId r) { return complex_.region(r) != complex_.region(best.removed.front()); };
    between_regions += std::any_of(best.removed.begin(), best.removed.end(), is_other) ? 1 : 0;
  });
  EXPECT_EQ(found, 100);
  EXPECT_GT(between_regions, 5);
}

// A split that is one vertex away from another must reach the bound, which is out of reach here.
TEST_F(BoundarySplitOf, EdgesAtNewVerticesStops) {
  BoundarySplit split(complex_, guard_, 0);
  EXPECT_EQ(expect_good_changes(1, [&](TetId t, Change& best) { try_faces(split, t, best); }), 0);
}

TEST_F(BoundarySplitOf, EdgesWhereAllIsWorseFindsNothing) {
  BoundarySplit split(complex_, guard_, static_cast<VertexId>(complex_.vertex_slots()));
  expect_nothing_better_than_the_best([&](TetId t, Change& best) { try_faces(split, t, best); });
}

TEST_F(BoundarySplitOf, InnerEdgesFindsNothing) {
  BoundarySplit split(complex_, guard_, static_cast<VertexId>(complex_.vertex_slots()));
  int inner = 0;
  for (TetId t = 0; t < complex_.tet_slots(); ++t) {
    for_each_edge(complex_.tet(t), [&](VertexId a, VertexId b) {
      const std::vector<VertexId> beside = guard_.boundary_neighbours(a);
      if (std::binary_search(beside.begin(), beside.end(), b)) return;
      ++inner;
      Change best;
      split.try_edge(a, b, best);
      EXPECT_FALSE(best.found());
    });
  }
  EXPECT_GT(inner, 100);
}

}  // namespace
}  // namespace scantet::optimize
