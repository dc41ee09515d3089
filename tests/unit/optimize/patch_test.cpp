#include <gtest/gtest.h>

#include <algorithm>

#include "scantet/optimize/edge_removal_impl.h"
#include "scantet/optimize/patch_impl.h"
#include "unit/optimize/operations.h"

namespace scantet::optimize {
namespace {

class PatchOf : public Operations {
 protected:
  Patch around(TetId t, int rings) const { return {complex_, tets_around(complex_, std::array{t}, rings)}; }
};

TEST_F(PatchOf, RingsGrow) {
  std::vector<TetId> inner{0};
  for (int rings = 0; rings < 4; ++rings) {
    const std::vector<TetId> outer = tets_around(complex_, std::array{TetId{0}}, rings);
    EXPECT_TRUE(std::is_sorted(outer.begin(), outer.end()));
    EXPECT_TRUE(std::includes(outer.begin(), outer.end(), inner.begin(), inner.end()));
    EXPECT_EQ(outer.size() > inner.size(), rings > 0);
    inner = outer;
  }
}

TEST_F(PatchOf, TetsIsLikeTheWhole) {
  const Patch patch = around(7, 2);
  const std::vector<TetId> tets = tets_around(complex_, std::array{TetId{7}}, 2);
  ASSERT_EQ(patch.complex().tet_slots(), tets.size());
  for (TetId t = 0; t < tets.size(); ++t) {
    EXPECT_EQ(patch.complex().region(t), complex_.region(tets[t]));
    for (std::size_t k = 0; k < 4; ++k) {
      const VertexId v = patch.complex().tet(t)[k];
      EXPECT_EQ(patch.vertices()[v], complex_.tet(tets[t])[k]);
      EXPECT_EQ(patch.complex().point(v), complex_.point(patch.vertices()[v]));
      EXPECT_EQ(patch.complex().on_boundary(v), complex_.on_boundary(patch.vertices()[v]));
    }
  }
}

TEST_F(PatchOf, TetsWithoutChangesChangesNothing) {
  const Patch patch = around(7, 2);
  patch.put_into(complex_, patch.complex());
  EXPECT_EQ(complex_.release().tets, mesh_.tets);
}

// All stars within the rim are whole, so what is found there is what would be found in the whole mesh.
TEST_F(PatchOf, TetsHasWholeStarsWithinItsRim) {
  const Patch patch = around(7, 2);
  std::size_t within = 0;
  for (VertexId v = 0; v < patch.vertices().size(); ++v) {
    const std::size_t whole = complex_.star(patch.vertices()[v]).size();
    if (patch.is_on_rim(v)) continue;
    ++within;
    EXPECT_EQ(patch.complex().star(v).size(), whole);
  }
  EXPECT_GT(within, 4U);
}

// Else facets would be asked for where there are none, which nothing can mend.
TEST_F(PatchOf, TetsHasNoBoundaryWhereItWasCutOut) {
  const std::vector<TetId> tets = tets_around(complex_, std::array{TetId{7}}, 2);
  const Patch patch(complex_, tets);
  std::size_t cut = 0;
  std::size_t on_boundary = 0;
  for (TetId t = 0; t < tets.size(); ++t) {
    for (int k = 0; k < 4; ++k) {
      const bool is_cut = patch.complex().across(t, k) == kNoTet && complex_.across(tets[t], k) != kNoTet;
      EXPECT_EQ(patch.complex().is_cut(t, k), is_cut);
      EXPECT_EQ(patch.complex().is_boundary_face(t, k), !is_cut && complex_.is_boundary_face(tets[t], k));
      cut += is_cut ? 1 : 0;
      on_boundary += patch.complex().is_boundary_face(t, k) ? 1 : 0;
    }
  }
  EXPECT_GT(cut, 4U);
  EXPECT_GT(on_boundary, 4U);
}

TEST_F(PatchOf, TetsTakesChangesToTheWhole) {
  int taken = 0;
  for (TetId t = 0; t < 200; ++t) {
    TetComplex whole(mesh_);
    const Patch patch(whole, tets_around(whole, std::array{t}, 2));
    TetComplex changed = patch.complex();
    SurfaceGuard guard(changed, domain_, kTolerance);
    Change change;
    change.reset(kAsked);
    for (TetId own = 0; own < changed.tet_slots() && !change.found(); ++own) {
      for_each_edge(changed.tet(own), [&](VertexId a, VertexId b) {
        if (change.found()) return;
        EdgeRemoval(changed, guard).try_edge(a, b, EdgeKind::inner, change);
        if (change.found() && !patch.keeps_off_rim(change)) change.reset(kAsked);
      });
    }
    if (!change.found()) continue;
    ++taken;
    const std::size_t fewer = change.removed.size() - change.added.size();
    make_change(changed, change);
    patch.put_into(whole, changed);
    const TetMesh mesh = whole.release();
    EXPECT_EQ(mesh.tets.size() + fewer, mesh_.tets.size());
    if (taken % 20 == 1) {
      EXPECT_TRUE(audit_of(mesh, domain_).passed());
    }
  }
  EXPECT_GT(taken, 50);
}

TEST_F(PatchOf, TetsRefusesChangesAtItsRim) {
  const Patch patch = around(7, 2);
  std::size_t refused = 0;
  for (TetId t = 0; t < patch.complex().tet_slots(); ++t) {
    Change change;
    change.removed = {t};
    refused += patch.keeps_off_rim(change) ? 0 : 1;
  }
  EXPECT_GT(refused, 10U);
  EXPECT_LT(refused, patch.complex().tet_slots());
  for (VertexId v = 0; v < patch.vertices().size(); ++v) {
    Change move;
    move.vertex = v;
    EXPECT_EQ(patch.keeps_off_rim(move), !patch.is_on_rim(v));
  }
}

}  // namespace
}  // namespace scantet::optimize
