// What the tests of improvement's operations share: whatever one of them finds is a mesh again once it is made.
#pragma once

#include <gtest/gtest.h>

#include "scantet/check/audit.h"
#include "scantet/optimize/surface_guard_impl.h"
#include "scantet/optimize/worst_first_impl.h"
#include "unit/optimize/test_meshes.h"

namespace scantet::optimize {

inline constexpr double kTolerance = 0.5;
inline constexpr double kRounding = 1e-12;  // the corners may come in another order

inline AuditReport audit_of(const TetMesh& mesh, const Domain& domain) {
  AuditOptions options;
  options.restricted_delaunay = false;
  return audit(mesh, &domain, options);
}

/// The mesh with the change made passes its audit, and has as many edges of curves and corners as before.
inline void expect_good_beside_curves(const TetMesh& mesh, Change change, const Domain& domain) {
  TetComplex changed(mesh);
  make_change(changed, change);
  const TetMesh after = changed.release();
  const AuditReport report = audit_of(after, domain);
  EXPECT_TRUE(report.passed()) << report.findings.front().message;
  EXPECT_EQ(after.curve_edges.size(), mesh.curve_edges.size());
  EXPECT_EQ(after.corners.size(), mesh.corners.size());
}

/// Tries everything on everything there is, and makes each change on a mesh of its own.
class Operations : public testing::Test {
 protected:
  /// Calls find(tet, best) for the tets of the mesh until `most` changes have been found. Returns how many were.
  template <class Find>
  int expect_good_changes(int most, const Find& find) {
    int found = 0;
    for (TetId t = 0; t < complex_.tet_slots() && found < most; ++t) {
      Change change;
      change.reset(kAsked);
      find(t, change);
      if (!change.found()) continue;
      ++found;
      expect_good(change);
    }
    return found;
  }

  void expect_good(Change change) const {
    TetComplex complex(mesh_);
    make_change(complex, change);
    for (const NewTet& added : change.added) EXPECT_LE(complex.sharpness(added.vertex), change.sharpest + kRounding);
    const TetMesh changed = complex.release();
    const AuditReport report = audit_of(changed, domain_);
    EXPECT_TRUE(report.passed()) << report.findings.front().message;
    EXPECT_EQ(report.boundary_euler, before_.boundary_euler);
    EXPECT_EQ(report.components.size(), before_.components.size());
  }

  /// No tet has all dihedral angles over 90°, so nothing can be found that is better than this.
  template <class Find>
  void expect_nothing_better_than_the_best(const Find& find) {
    for (TetId t = 0; t < complex_.tet_slots(); ++t) {
      Change change;
      change.reset(-0.9);
      find(t, change);
      EXPECT_FALSE(change.found());
    }
  }

  static constexpr double kAsked = 0.999;  // sharpness of 1.8°: nearly anything will do
  Onion domain_;
  TetMesh mesh_ = refined(domain_, 1.1);
  AuditReport before_ = audit_of(mesh_, domain_);
  TetComplex complex_{mesh_};
  SurfaceGuard guard_{complex_, domain_, kTolerance};
};

template <class Try>
void for_each_edge(const Tet& tet, const Try& try_edge) {
  for (const VertexId a : tet) {
    for (const VertexId b : tet) {
      if (a != b) try_edge(a, b);
    }
  }
}

}  // namespace scantet::optimize
