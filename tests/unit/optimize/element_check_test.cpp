#include <gtest/gtest.h>

#include "scantet/base/mesh_topology.h"
#include "scantet/optimize/element_check_impl.h"
#include "unit/optimize/test_meshes.h"

namespace scantet::optimize {
namespace {

class CheckedOnion : public testing::Test {
 protected:
  Onion domain_;
  UniformSize size_{1.1};
  // Facets have been meshed with a radius-edge ratio up to 1.
  RuleTarget rules_{{.facet_radius_edge = 0.7, .facet_distance_mm = {}, .small_slack = 1}, &size_};
  TetComplex complex_{refined(domain_, 1.1), TetJudge({10, 180, 0, rules_})};
};

TEST_F(CheckedOnion, LooksAtBoundaryFacesOnly) {
  const FacetJudge judge(domain_, rules_);
  const ElementCheck check(complex_, &judge);
  int bad = 0;
  for (TetId t = 0; t < complex_.tet_slots(); ++t) {
    double sharpest = kNoFacets;
    for (int k = 0; k < 4; ++k) {
      const double of_face = check.of_face(t, k);
      sharpest = std::max(sharpest, of_face);
      if (!complex_.is_boundary_face(t, k)) {
        EXPECT_EQ(of_face, kNoFacets);
        continue;
      }
      const Triangle f = face_of(complex_.tet(t), k);
      Crossings crossings;
      const Corners corners{complex_.point(f[0]), complex_.point(f[1]), complex_.point(f[2])};
      EXPECT_EQ(of_face, check.of_facet(corners, crossings));
      EXPECT_EQ(of_face > check.bound(), judge.shares(corners, crossings).least() < 1);
      bad += of_face > check.bound() ? 1 : 0;
    }
    EXPECT_EQ(check.of_faces(t), sharpest);
  }
  EXPECT_GT(bad, 10);
}

// A tet is mended before its faces.
TEST_F(CheckedOnion, LooksAtTheFacesOfTetsThatAreGoodEnough) {
  const FacetJudge judge(domain_, rules_);
  const ElementCheck check(complex_, &judge);
  for (TetId t = 0; t < complex_.tet_slots(); ++t) {
    const double of_tet = complex_.sharpness(complex_.tet(t));
    EXPECT_EQ(check.of(t), of_tet > check.bound() ? of_tet : std::max(of_tet, check.of_faces(t)));
  }
}

TEST_F(CheckedOnion, AsksNothingOfFacetsWithoutAJudge) {
  const ElementCheck check(complex_, nullptr);
  for (TetId t = 0; t < complex_.tet_slots(); ++t) {
    EXPECT_EQ(check.of(t), complex_.sharpness(complex_.tet(t)));
    EXPECT_EQ(check.of_faces(t), kNoFacets);
  }
}

}  // namespace
}  // namespace scantet::optimize
