#include <gtest/gtest.h>

#include "scantet/base/parallel.h"
#include "scantet/optimize/coarsening_impl.h"
#include "scantet/optimize/short_edges_impl.h"
#include "unit/optimize/operations.h"

namespace scantet::optimize {
namespace {

constexpr double kSizeMm = 0.5;
const ElementBounds kShape{.min_dihedral_deg = 8};

struct Coarsened {
  TetMesh mesh;
  std::uint64_t changes;
};

Coarsened coarsened(const TetMesh& mesh, const Domain& domain, const EdgeTarget& target, Effort effort,
                    const std::vector<Box>& held = {}) {
  const UniformSize size(2 * kSizeMm);
  const FacetJudge facets(domain, {{}, &size});
  TetComplex complex(mesh, TetJudge(kShape));
  Progress progress;
  const std::uint64_t changes = coarsen(complex, domain, &facets, target, held, effort, progress);
  return {complex.release(), changes};
}

/// A ball in a shell, all edges of which are about as long as the size.
class Coarsening : public testing::Test {
 protected:
  std::uint64_t tets_under_bound(const TetMesh& mesh) const {
    const TetComplex complex(mesh, TetJudge(kShape));
    return sharp_tets(complex).size();
  }

  Onion domain_;
  TetMesh mesh_ = refined(domain_, kSizeMm);
  EdgeTarget target_{0.8 * kSizeMm, 0, nullptr, true};
};

TEST_F(Coarsening, KeepsTheTopologyTheBoundsAndTheBoundaryOnTheSurface) {
  const AuditReport before = audit_of(mesh_, domain_);
  for (const Effort effort : {Effort::contract, Effort::move}) {
    const Coarsened after = coarsened(mesh_, domain_, target_, effort);
    EXPECT_GT(after.changes, 10U);
    EXPECT_EQ(after.mesh.vertices.size() + after.changes, mesh_.vertices.size());
    EXPECT_LT(short_edges(after.mesh, target_).size(), short_edges(mesh_, target_).size());
    const AuditReport report = audit_of(after.mesh, domain_);
    EXPECT_TRUE(report.passed()) << report.findings.front().message;
    EXPECT_EQ(report.boundary_euler, before.boundary_euler);
    EXPECT_EQ(report.components.size(), before.components.size());
    EXPECT_LE(tets_under_bound(after.mesh), tets_under_bound(mesh_));
    constexpr double kVolumeShare = 0.02;
    expect_sound(mesh_, after.mesh, kVolumeShare);
  }
}

TEST_F(Coarsening, TakesNoVertexThatIsHeld) {
  const Box half{{0, -100, -100}, {100, 100, 100}};
  const Coarsened after = coarsened(mesh_, domain_, target_, Effort::contract, {half});
  EXPECT_GT(after.changes, 3U);
  const auto in_half = [&](const TetMesh& mesh) {
    return std::count_if(mesh.vertices.begin(), mesh.vertices.end(), [&](const Point& p) { return half.contains(p); });
  };
  EXPECT_EQ(in_half(after.mesh), in_half(mesh_));
}

TEST_F(Coarsening, PutsVerticesAtNewPlacesWhereThatHelps) {
  const Coarsened contracted = coarsened(mesh_, domain_, target_, Effort::contract);
  const Coarsened moved = coarsened(contracted.mesh, domain_, target_, Effort::move);
  EXPECT_GT(moved.changes, 2U);
}

TEST_F(Coarsening, LeavesWhatIsLongEnough) {
  const Coarsened after = coarsened(mesh_, domain_, {0.01 * kSizeMm, 0, nullptr, true}, Effort::move);
  EXPECT_EQ(after.changes, 0U);
  EXPECT_EQ(after.mesh.vertices, mesh_.vertices);
}

TEST_F(Coarsening, NumberOfThreadsDoesNotMatter) {
  std::vector<Coarsened> all;
  for (const std::size_t threads : {1, 2, 5}) {
    with_threads(threads, [&] { all.push_back(coarsened(mesh_, domain_, target_, Effort::move)); });
  }
  for (const Coarsened& one : all) {
    EXPECT_EQ(one.mesh.vertices, all[0].mesh.vertices);
    EXPECT_EQ(one.mesh.tets, all[0].mesh.tets);
  }
}

}  // namespace
}  // namespace scantet::optimize
