#include <gtest/gtest.h>

#include "boundary_flags.h"
#include "cancelled_after.h"
#include "scantet/base/mesh_topology.h"
#include "scantet/base/parallel.h"
#include "scantet/domain/analytic.h"
#include "scantet/optimize/exudation_impl.h"
#include "scantet/quality/measures.h"
#include "unit/optimize/test_meshes.h"

namespace scantet::optimize {
namespace {

struct Exuded {
  TetMesh mesh;
  std::uint64_t pumps;
};

Exuded exuded(const TetMesh& mesh, double min_dihedral_deg) {
  TetComplex complex(mesh, TetJudge({.min_dihedral_deg = min_dihedral_deg}));
  Progress progress;
  const std::uint64_t pumps = exude(complex, progress);
  return {complex.release(), pumps};
}

std::vector<double> smallest_dihedrals_deg(const TetMesh& mesh) {
  std::vector<double> angles;
  for (const Tet& t : mesh.tets) {
    const auto& v = mesh.vertices;
    const TetMeasures m = measure_tet(v[t[0]], v[t[1]], v[t[2]], v[t[3]]);
    angles.push_back(*std::min_element(m.dihedral_deg.begin(), m.dihedral_deg.end()));
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

/// What exudation promises for any mesh.
void expect_kept(const TetMesh& before, const TetMesh& after) {
  EXPECT_EQ(after.vertices, before.vertices);
  EXPECT_EQ(test::boundary_flags(after), test::boundary_flags(before));
  EXPECT_EQ(after.boundary_facets, before.boundary_facets);
  EXPECT_EQ(after.facet_regions, before.facet_regions);
  expect_sound(before, after, 1e-11);
}

TEST(Exudation, RemovesASliver) {
  const TetMesh before = octahedron_with_sliver(1);
  ASSERT_LT(smallest_dihedrals_deg(before).front(), 3);
  const Exuded after = exuded(before, 20);
  EXPECT_EQ(after.pumps, 1U);
  EXPECT_EQ(after.mesh.tets.size(), 4U);
  EXPECT_GT(smallest_dihedrals_deg(after.mesh).front(), 40);
  expect_kept(before, after.mesh);
}

TEST(Exudation, LeavesAloneWhatIsGoodEnough) {
  const TetMesh before = octahedron_with_sliver(1);
  const Exuded after = exuded(before, 1);
  EXPECT_EQ(after.pumps, 0U);
  EXPECT_EQ(after.mesh.tets, before.tets);
}

// The sliver is a region of its own: all of its faces are boundary facets.
TEST(Exudation, DoesNotTouchTheBoundaryBetweenRegions) {
  const TetMesh before = octahedron_with_sliver(2);
  const Exuded after = exuded(before, 20);
  EXPECT_EQ(after.pumps, 0U);
  expect_kept(before, after.mesh);
}

TEST(Exudation, StopsWhenCancelled) {
  const TetMesh before = octahedron_with_sliver(1);
  TetComplex complex(before, TetJudge({.min_dihedral_deg = 20}));
  test::CancelledAfter progress(0);
  EXPECT_EQ(exude(complex, progress), 0U);
  expect_kept(before, complex.release());
}

class ExudationOf : public testing::TestWithParam<double> {};

TEST_P(ExudationOf, Tanglecube) {
  const TetMesh before = refined(*make_tanglecube(), 0.2);
  const Exuded after = exuded(before, GetParam());
  expect_kept(before, after.mesh);
  EXPECT_GT(after.pumps, 0U);
  const auto slivers = [&](const TetMesh& mesh) {
    std::vector<double> angles = smallest_dihedrals_deg(mesh);
    angles.erase(std::lower_bound(angles.begin(), angles.end(), GetParam()), angles.end());
    return angles;
  };
  const std::vector<double> old_slivers = slivers(before);
  const std::vector<double> left = slivers(after.mesh);
  EXPECT_LT(left.size(), old_slivers.size() / 2);
  // The smallest angle that changed has got larger.
  const auto [old_angle, angle] = std::mismatch(old_slivers.begin(), old_slivers.end(), left.begin(), left.end());
  EXPECT_TRUE(angle == left.end() || *angle > *old_angle);
}

// Two regions that meet in a ragged interface full of vertices of the inside.
TEST_P(ExudationOf, TwoRegions) {
  TetMesh before = refined(*make_torus({0, 0, 0}, 3, 1.2), 0.3);
  for (std::size_t i = 0; i < before.tets.size(); ++i) {
    Point sum;
    for (const VertexId v : before.tets[i]) sum = sum + before.vertices[v];
    before.tet_regions[i] = sum.x > 0 ? 1 : 2;
  }
  build_boundary(before);
  const Exuded after = exuded(before, GetParam());
  expect_kept(before, after.mesh);
  EXPECT_GT(after.pumps, 0U);
}

TEST_P(ExudationOf, SameForAnyNumberOfThreads) {
  const TetMesh before = refined(*make_sphere({0, 0, 0}, 4), 0.4);
  const Exuded first = exuded(before, GetParam());
  EXPECT_GT(first.pumps, 0U);
  for (const std::size_t threads : {1, 2, 3}) {
    with_threads(threads, [&] {
      const Exuded again = exuded(before, GetParam());
      EXPECT_EQ(again.pumps, first.pumps);
      EXPECT_EQ(again.mesh.tets, first.mesh.tets);
    });
  }
}

INSTANTIATE_TEST_SUITE_P(Bounds, ExudationOf, testing::Values(10, 20, 30));

TEST(Exudation, ReachesThePapersFiveDegrees) {
  for (const auto& domain : {make_sphere({0, 0, 0}, 4), make_shell({0, 0, 0}, 2, 4), make_torus({0, 0, 0}, 4, 1.5)}) {
    const TetMesh before = refined(*domain, 0.4);
    ASSERT_LT(smallest_dihedrals_deg(before).front(), 5);
    EXPECT_GE(smallest_dihedrals_deg(exuded(before, 10).mesh).front(), 5);
  }
}

}  // namespace
}  // namespace scantet::optimize
