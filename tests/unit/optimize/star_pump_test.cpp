#include <gtest/gtest.h>

#include "scantet/optimize/star_pump_impl.h"
#include "unit/optimize/operations.h"

namespace scantet::optimize {
namespace {

class StarPumpOf : public Operations {};

TEST_F(StarPumpOf, TetsReplacesThem) {
  StarPump star(complex_);
  EXPECT_EQ(expect_good_changes(100, [&](TetId t, Change& best) { star.try_tet(t, best); }), 100);
}

TEST_F(StarPumpOf, TetsWhereAllIsWorseFindsNothing) {
  StarPump star(complex_);
  expect_nothing_better_than_the_best([&](TetId t, Change& best) { star.try_tet(t, best); });
}

TEST_F(StarPumpOf, TetsTakesAwayWhatItWasAskedFor) {
  StarPump star(complex_);
  int found = 0;
  for (TetId t = 0; t < complex_.tet_slots(); ++t) {
    Change best;
    best.reset(kAsked);
    star.try_tet(t, best);
    if (!best.found()) continue;
    ++found;
    EXPECT_EQ(std::count(best.removed.begin(), best.removed.end(), t), 1);
    for (const TetId r : best.removed) {
      EXPECT_NE(std::find(best.read.begin(), best.read.end(), r), best.read.end());
    }
  }
  EXPECT_GT(found, 100);
}

TEST(StarPump, SaysWhichVertexWeighsHowMuch) {
  const TetComplex complex(octahedron_with_sliver(1), TetJudge({.min_dihedral_deg = 20}));
  const std::vector<double> weights_mm2(complex.vertex_slots(), 0);
  Change weighted;
  StarPump(complex, weights_mm2).try_tet(0, weighted);
  ASSERT_TRUE(weighted.found());
  ASSERT_NE(weighted.weighted, kNoVertex);
  EXPECT_EQ(weighted.vertex, kNoVertex);
  EXPECT_GE(weighted.weight_mm2, 0);
  for (VertexId u = 0; u < complex.vertex_slots(); ++u) {
    if (u == weighted.weighted) continue;
    EXPECT_LE(weighted.weight_mm2, squared_distance(complex.point(u), complex.point(weighted.weighted)))
        << "a vertex may not be hidden";
  }
  Change weightless;
  StarPump(complex).try_tet(0, weightless);
  EXPECT_EQ(weightless.weighted, kNoVertex);
  EXPECT_EQ(weightless.removed, weighted.removed);
  EXPECT_EQ(weightless.sharpest, weighted.sharpest);
}

TEST(StarPump, DoesNotGrowThroughTheBoundary) {
  const TetComplex complex(octahedron_with_sliver(2));
  StarPump star(complex);
  for (TetId t = 0; t < complex.tet_slots(); ++t) {
    Change best;
    star.try_tet(t, best);
    EXPECT_FALSE(best.found());
  }
}

}  // namespace
}  // namespace scantet::optimize
