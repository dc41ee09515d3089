// The operations of improvement one by one: what each finds is a mesh again once it is made.
#include <gtest/gtest.h>

#include "scantet/check/audit.h"
#include "scantet/optimize/contraction_impl.h"
#include "scantet/optimize/edge_removal_impl.h"
#include "scantet/optimize/edge_split_impl.h"
#include "scantet/optimize/smoothing_impl.h"
#include "scantet/optimize/star_pump_impl.h"
#include "scantet/optimize/worst_first_impl.h"
#include "scantet/quality/measures.h"
#include "unit/optimize/test_meshes.h"

namespace scantet::optimize {
namespace {

constexpr double kTolerance = 0.5;
constexpr double kRounding = 1e-12;  // the corners may come in another order

AuditReport audit_of(const TetMesh& mesh, const Domain& domain) {
  AuditOptions options;
  options.restricted_delaunay = false;
  return audit(mesh, &domain, options);
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

TEST_F(Operations, RemovingInnerEdges) {
  EdgeRemoval removal(complex_, guard_);
  EXPECT_EQ(expect_good_changes(100,
                                [&](TetId t, Change& best) {
                                  for_each_edge(complex_.tet(t), [&](VertexId a, VertexId b) {
                                    removal.try_edge(a, b, EdgeKind::inner, best);
                                  });
                                  for (const NewTet& added : best.added)
                                    EXPECT_EQ(added.region, complex_.region(best.removed.front()));
                                }),
            100);
}

TEST_F(Operations, FlippingBoundaryEdges) {
  EdgeRemoval removal(complex_, guard_);
  EXPECT_GT(expect_good_changes(100,
                                [&](TetId t, Change& best) {
                                  for_each_edge(complex_.tet(t), [&](VertexId a, VertexId b) {
                                    removal.try_edge(a, b, EdgeKind::boundary, best);
                                  });
                                }),
            20);
}

TEST_F(Operations, GrowingStars) {
  StarPump growth(complex_);
  EXPECT_EQ(expect_good_changes(100, [&](TetId t, Change& best) { growth.try_tet(t, best); }), 100);
}

TEST_F(Operations, MovingVertices) {
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

TEST_F(Operations, ContractingEdges) {
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

TEST_F(Operations, SplittingEdges) {
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
TEST_F(Operations, SplittingStopsWhereItWasSplit) {
  EdgeSplit split(complex_, 0);
  EXPECT_EQ(expect_good_changes(1,
                                [&](TetId t, Change& best) {
                                  for_each_edge(complex_.tet(t),
                                                [&](VertexId a, VertexId b) { split.try_edge(a, b, best); });
                                }),
            0);
}

TEST_F(Operations, ChangeNothingWhereAllIsWorse) {
  EdgeRemoval removal(complex_, guard_);
  StarPump growth(complex_);
  Smoothing smoothing(complex_, guard_);
  Contraction contraction(complex_, guard_);
  EdgeSplit split(complex_, 0);
  for (TetId t = 0; t < complex_.tet_slots(); ++t) {
    Change best;
    best.reset(-0.9);  // no tet has all dihedral angles over 90°
    growth.try_tet(t, best);
    for (const VertexId v : complex_.tet(t)) smoothing.try_vertex(v, best);
    for_each_edge(complex_.tet(t), [&](VertexId a, VertexId b) {
      removal.try_edge(a, b, EdgeKind::inner, best);
      removal.try_edge(a, b, EdgeKind::boundary, best);
      contraction.try_edge(a, b, best);
      split.try_edge(a, b, best);
    });
    EXPECT_FALSE(best.found());
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
