#include <set>

#include "cancelled_after.h"
#include "scantet/domain/analytic.h"
#include "scantet/refine/rules_and_topology_impl.h"
#include "unit/solids.h"
#include "unit/surface/samples.h"

namespace scantet::engine {
namespace {

/// Whether the boundary of the mesh is a surface for each of the domain's.
bool is_whole(RestrictedTriangulation& t) {
  const std::vector<FacetCode> facets = boundary_facets(t.triangulation());
  check_all_disks(t.triangulation(), t.disks(), [&] { return facets; });
  return BoundarySurfaces(t, BoundaryFacets(t, facets)).is_whole();
}

std::size_t pieces_inside(RestrictedTriangulation& t) {
  Pieces pieces(t, BoundarySurfaces(t, BoundaryFacets(t, boundary_facets(t.triangulation()))));
  std::set<std::uint32_t> numbers;
  for (const FacetCode side : pieces.side_facets()) {
    if (t.triangulation().info(side / 4).region != kOutside) numbers.insert(pieces.of(side / 4));
  }
  return 1 + numbers.size();
}

TEST(RulesAndTopology, BothHoldWhenItIsDone) {
  const auto torus = make_torus({}, 5, 0.7);
  RestrictedTriangulation t = triangulated(*torus, sparse_sample(*torus, 0.6, 9));
  const UniformSize size(2);
  Progress progress;
  RulesAndTopology both(*torus, t, size, {}, progress);
  EXPECT_FALSE(is_whole(t));
  both.refine();
  both.untangle();
  EXPECT_EQ(both.stop(), Stop::converged);
  EXPECT_TRUE(is_whole(t));
  EXPECT_EQ(both.refinement().unmet().total(), 0U);

  MeshResult result;
  both.account(result);
  EXPECT_EQ(result.counts.absorbed_tets, 0U);
  const RuleCounts& by_rule = result.counts.inserted;
  const std::uint64_t inserted = result.counts.repair_points + by_rule.r1 + by_rule.r2 + by_rule.r3_1 + by_rule.r3_2;
  EXPECT_EQ(inserted, t.vertex_count() - sparse_sample(*torus, 0.6, 9).size());
  EXPECT_TRUE(result.tangled.empty());
}

TEST(RulesAndTopology, RepairAddsWhatTheRulesDoNotAskFor) {
  const auto torus = make_torus({}, 5, 0.3);
  const UniformSize coarse(8);
  RestrictedTriangulation t = triangulated(*torus, sparse_sample(*torus, 0.5, 11));
  MesherOptions options;
  options.bounds.small_slack = 1;  // facets of any shape already are a torus
  Progress progress;
  Refinement rules_alone(t, coarse, options, progress);
  EXPECT_EQ(rules_alone.run(Rule::r3), Stop::converged);
  EXPECT_FALSE(is_whole(t));
  RulesAndTopology both(*torus, t, coarse, options, progress);
  both.refine();
  both.untangle();
  EXPECT_TRUE(is_whole(t));
  MeshResult result;
  both.account(result);
  EXPECT_GT(result.counts.repair_points, 0U);
  EXPECT_EQ(both.refinement().unmet().total(), 0U) << "after each repair the rules are applied again";
}

/// A dumbbell that lists its component, so that its pieces are known to be one.
class Listed final : public Domain {
 public:
  explicit Listed(test::Solids solids) : solids_(std::move(solids)) {}
  Box bounds() const override { return solids_.bounds(); }
  Region region_at(const Point& p) const override { return solids_.region_at(p); }
  void crossings(const Segment& segment, Crossings& out) const override { solids_.crossings(segment, out); }
  std::vector<Component> components() const override { return {{1, {5, 0, 0}, bounds()}}; }

 private:
  test::Solids solids_;
};

TEST(RulesAndTopology, UntanglingFindsANeckThatTheSampleMissed) {
  const Listed dumbbell(test::dumbbell(0.1));
  const UniformSize size(1.5);
  RestrictedTriangulation t = triangulated(dumbbell, without_neck(dumbbell));
  Progress progress;
  RulesAndTopology both(dumbbell, t, size, {}, progress);
  EXPECT_GT(pieces_inside(t), 1U);
  both.refine();
  EXPECT_GT(pieces_inside(t), 1U) << "else there is nothing to find";
  both.untangle();
  EXPECT_EQ(pieces_inside(t), 1U);
  EXPECT_EQ(both.stop(), Stop::converged);
}

TEST(RulesAndTopology, StopsAtTheLimitAndWhenItIsCancelled) {
  const auto torus = make_torus({}, 5, 2);
  const UniformSize size(0.5);
  MesherOptions options;
  RestrictedTriangulation limited = triangulated(*torus, sparse_sample(*torus, 0.9, 2));
  options.max_vertices = limited.vertex_count() + 100;
  Progress progress;
  RulesAndTopology few(*torus, limited, size, options, progress);
  few.refine();
  EXPECT_EQ(few.stop(), Stop::limit);
  EXPECT_LE(limited.vertex_count(), options.max_vertices);
  EXPECT_GT(few.refinement().unmet().total(), 0U);

  test::CancelledAfter cancelled(1);
  RestrictedTriangulation t = triangulated(*torus, sparse_sample(*torus, 0.9, 2));
  RulesAndTopology none(*torus, t, size, {}, cancelled);
  none.refine();
  const std::uint64_t vertices = t.vertex_count();
  none.untangle();
  EXPECT_EQ(none.stop(), Stop::cancelled);
  EXPECT_EQ(t.vertex_count(), vertices) << "nothing is done after that";
}

}  // namespace
}  // namespace scantet::engine
