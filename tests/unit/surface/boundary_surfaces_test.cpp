#include <gtest/gtest.h>

#include <map>
#include <set>

#include "scantet/base/parallel.h"
#include "scantet/base/union_find.h"
#include "scantet/domain/analytic.h"
#include "scantet/surface/boundary_surfaces_impl.h"
#include "unit/nested_balls.h"
#include "unit/surface/samples.h"

namespace scantet::engine {
namespace {

std::array<PointId, 3> vertices_of(const Triangulation& t, FacetCode facet) {
  return facet_vertices(t.cell(facet / 4), static_cast<int>(facet % 4));
}

/// The surfaces, joined facet by facet.
std::vector<std::uint32_t> expected_surfaces(const Triangulation& t, const DiskNotes& notes,
                                             const std::vector<FacetCode>& facets) {
  UnionFind sets(facets.size());
  std::map<PointId, std::uint32_t> facet_at;
  for (std::uint32_t i = 0; i < facets.size(); ++i) {
    for (const PointId v : vertices_of(t, facets[i])) {
      if (notes.has_disk(v)) sets.unite(facet_at.try_emplace(v, i).first->second, i);
    }
  }
  std::vector<std::uint32_t> numbers;
  sets.number_sets(numbers);
  return numbers;
}

void check(const Domain& domain, std::vector<SamplePoint> sample, bool knows_disks) {
  RestrictedTriangulation restricted = triangulated(domain, std::move(sample));
  Triangulation& t = restricted.triangulation();
  const std::vector<FacetCode> facets = boundary_facets(t);
  if (knows_disks) check_all_disks(t, restricted.disks(), [&] { return facets; });
  const std::vector<std::uint32_t> expected = expected_surfaces(t, restricted.disks(), facets);
  const BoundaryFacets all(restricted, facets);
  const BoundarySurfaces surfaces(restricted, all);
  std::vector<std::uint32_t> count(surfaces.surfaces().size());
  std::map<std::optional<Patch>, std::set<std::uint32_t>> of_patch;
  std::set<PointId> vertices;
  bool has_disks = true;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    ASSERT_EQ(surfaces.seen()[i].surface, expected[i]) << "facet " << i;
    ASSERT_EQ(surfaces.seen()[i].patch, patch_of(restricted, facets[i]));
    ASSERT_EQ(surfaces.surface_of(facets[i]), expected[i]);
    ASSERT_EQ(surfaces.surface_of(t.cell(facets[i] / 4).neighbor[facets[i] % 4]), expected[i]);
    if (count[expected[i]]++ == 0) {
      EXPECT_EQ(surfaces.surfaces()[expected[i]].first, i);
    }
    of_patch[surfaces.seen()[i].patch].insert(expected[i]);
    for (const PointId v : vertices_of(t, facets[i])) {
      vertices.insert(v);
      has_disks = has_disks && restricted.disks().has_disk(v);
    }
  }
  bool is_one_each = true;
  bool has_split = false;
  std::set<std::uint32_t> taking_part;
  for (const auto& [patch, numbers] : of_patch) {
    is_one_each = is_one_each && numbers.size() == 1;
    if (!patch) continue;
    EXPECT_TRUE(surfaces.has(*patch));
    EXPECT_EQ(surfaces.is_split({0, patch}), numbers.size() > 1);
    if (numbers.size() == 1) continue;
    has_split = true;
    taking_part.insert(numbers.begin(), numbers.end());
  }
  for (std::uint32_t n = 0; n < count.size(); ++n) {
    EXPECT_EQ(surfaces.surfaces()[n].facets, count[n]);
    EXPECT_EQ(surfaces.surfaces()[n].takes_part, taking_part.contains(n));
  }
  EXPECT_EQ(surfaces.has_split_patches(), has_split);
  EXPECT_EQ(surfaces.is_whole(), has_disks && is_one_each);
  EXPECT_EQ(surfaces.euler_number(), static_cast<std::int64_t>(vertices.size()) - std::int64_t(facets.size()) / 2);
}

TEST(BoundarySurfaces, AreThoseThatFacetsTellOneByOne) {
  for (const bool knows_disks : {false, true}) {
    for (const std::size_t one_in : {1, 2, 5, 9}) {
      const auto tanglecube = make_tanglecube();
      check(*tanglecube, sparse_sample(*tanglecube, 0.4, one_in), knows_disks);
      const auto shell = make_shell({}, 4.5, 5);
      check(*shell, sparse_sample(*shell, 1, one_in), knows_disks);
    }
  }
}

TEST(BoundarySurfaces, OfASphereAndATorusHaveTheirEulerNumbers) {
  const auto euler_number = [](const Domain& domain, double spacing_mm) {
    RestrictedTriangulation t = triangulated(domain, sparse_sample(domain, spacing_mm, 1));
    const std::vector<FacetCode> facets = boundary_facets(t.triangulation());
    check_all_disks(t.triangulation(), t.disks(), [&] { return facets; });
    const BoundaryFacets all(t, facets);
    const BoundarySurfaces surfaces(t, all);
    EXPECT_TRUE(surfaces.is_whole());
    return surfaces.euler_number();
  };
  EXPECT_EQ(euler_number(*make_sphere({}, 5), 1), 2);
  EXPECT_EQ(euler_number(*make_torus({}, 5, 2), 0.6), 0);
  EXPECT_EQ(euler_number(test::NestedBalls(2.5, 5), 0.8), 6) << "the inner sphere bounds two regions";
}

}  // namespace
}  // namespace scantet::engine
