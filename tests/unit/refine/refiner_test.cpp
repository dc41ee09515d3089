#include <map>

#include "scantet/domain/analytic.h"
#include "scantet/refine/refinement_impl.h"
#include "unit/surface/samples.h"

namespace scantet::engine {
namespace {

class RefinerTest : public testing::Test {
 protected:
  RefinerTest() : t_(triangulated(*torus_, sparse_sample(*torus_, 0.9, 2))) {}

  std::vector<Violation> violations(const Rules& rules) const {
    std::vector<Violation> all;
    const Triangulation& t = t_.triangulation();
    for_each_inner_facet(t, [&](FacetCode facet) {
      const std::uint32_t ball = t.info(facet / 4).balls[facet % 4];
      if (ball == kNone) return;
      if (const auto violation = rules.facet(t_, ball)) all.push_back(*violation);
    });
    for (CellId c = 0; c < t.cell_slots(); ++c) {
      if (!t.is_cell(c)) continue;
      if (const auto violation = rules.tet(t_, c)) all.push_back(*violation);
    }
    return all;
  }
  std::size_t count(const Rules& rules, Rule last) const {
    std::size_t count = 0;
    for (const Violation& violation : violations(rules)) count += violation.rule <= last ? 1 : 0;
    return count;
  }
  Refiner refiner(const Rules& rules, std::uint64_t most) {
    broken_.assign(t_.balls().slots(), 0);
    Refiner refiner(t_, rules, Editor(t_), broken_, most);
    for (const Violation& violation : violations(rules)) {
      if (violation.rule != Rule::r3) broken_[violation.element] = 1;
      refiner.push(violation);
    }
    return refiner;
  }
  static bool never() { return false; }

  std::unique_ptr<Domain> torus_ = make_torus({}, 5, 2);
  RestrictedTriangulation t_;
  const UniformSize size_{1};
  const Rules rules_{size_, {}};
  BrokenFacets broken_;
};

TEST_F(RefinerTest, RunsUntilNoRuleUpToTheLastIsBroken) {
  ASSERT_GT(count(rules_, Rule::r2), 10U);
  ASSERT_GT(count(rules_, Rule::r3), count(rules_, Rule::r2));
  for (const Rule last : {Rule::r2, Rule::r3}) {
    Refiner some = refiner(rules_, 100'000);
    const std::uint64_t before = t_.vertex_count();
    some.run(last, never);
    EXPECT_EQ(count(rules_, last), 0U);
    std::uint64_t points = 0;
    for (const std::uint64_t of_rule : some.work().points) points += of_rule;
    EXPECT_EQ(t_.vertex_count(), before + points);
    EXPECT_EQ(some.work().points[2] > 0, last == Rule::r3) << "R3.1";
    std::vector<Violation> left;
    std::vector<Violation> given_up;
    some.retire(left, given_up);
    EXPECT_TRUE(given_up.empty());
    for (const Violation& violation : left) EXPECT_TRUE(violation.rule > last || !violation.alive(t_));
  }
}

TEST_F(RefinerTest, TetsThatABoundaryPointLeavesAsTheyAreAreAskedAgain) {
  MesherOptions options;
  options.bounds.alpha = 3;  // large balls: many circumcentres are in one
  const UniformSize fine(0.7);
  const Rules rules(fine, options);
  Refiner all = refiner(rules, 100'000);
  all.run(Rule::r3, never);
  EXPECT_GT(all.work().points[3], 100U) << "R3.2";
  EXPECT_EQ(count(rules, Rule::r3), 0U);
}

TEST_F(RefinerTest, PointsOfTheBoundaryAreOnItAndOthersAreInNoBall) {
  Refiner all = refiner(rules_, 100'000);
  const PointId first = t_.triangulation().vertex_slots();
  all.run(Rule::r3, never);
  const auto& points = all.work().points;
  std::map<bool, std::uint64_t> count;
  for (PointId v = first; v < t_.triangulation().vertex_slots(); ++v) {
    const VertexInfo& info = t_.triangulation().vertex_info(v);
    const Point& p = t_.triangulation().point(v);
    ++count[info.on_boundary()];
    EXPECT_EQ(info.on_boundary(), std::abs(std::hypot(std::hypot(p.x, p.y) - 5, p.z) - 2) < 1e-9);
    EXPECT_EQ(info.patch.is_known(), info.on_boundary());
  }
  EXPECT_EQ(count[true], points[0] + points[1] + points[3]) << "R1, R2, R3.2";
  EXPECT_EQ(count[false], points[2]) << "R3.1";
  EXPECT_GT(points[3], 0U);
  for (std::uint32_t b = 0; b < t_.balls().slots(); ++b) {  // that R3.1 captured none shows in those that are left
    const SurfaceBall& ball = t_.balls()[b];
    if (ball.generation % 2 == 0) continue;
    for (PointId v = first; v < t_.triangulation().vertex_slots(); ++v) {
      EXPECT_GE(distance(t_.triangulation().point(v), ball.center), ball.radius * (1 - 1e-9));
    }
  }
}

TEST_F(RefinerTest, StopsAtTheMostAndWhenItIsTold) {
  const std::uint64_t before = t_.vertex_count();
  refiner(rules_, 7).run(Rule::r3, never);
  EXPECT_EQ(t_.vertex_count(), before + 7);
  const UniformSize fine(0.3);
  refiner(Rules(fine, {}), 100'000).run(Rule::r3, [] { return true; });
  EXPECT_LT(t_.vertex_count(), before + 7 + 2000);
  EXPECT_GT(t_.vertex_count(), before + 7);
}

TEST_F(RefinerTest, QueueGivesTheWorstOfTheFirstRuleAndForgetsWhatIsGone) {
  ViolationQueue queue(t_);
  CellId inside = 0;
  while (t_.triangulation().info(inside).region == kOutside) ++inside;
  const std::uint32_t generation = t_.triangulation().info(inside).generation;
  std::uint32_t ball = 0;
  while (t_.balls()[ball].generation % 2 == 0) ++ball;
  const std::uint32_t use = t_.balls()[ball].generation;
  queue.push({Rule::r3, 9, 1, inside, generation});
  queue.push({Rule::r2, 2, 5, ball, use});
  queue.push({Rule::r2, 3, 4, ball, use});
  queue.push({Rule::r2, 3, 6, ball, use});
  queue.push({Rule::r2, 8, 1, ball, use + 2});  // of another use of that slot
  queue.push({Rule::r1, 1, 1, ball, use});
  EXPECT_EQ(queue.size(), 6U);
  const auto take = [&](Rule last) {
    const auto violation = queue.take(last);
    return violation ? std::pair{violation->rule, violation->tie} : std::pair{Rule::r1, std::uint64_t{0}};
  };
  EXPECT_EQ(take(Rule::r3), std::pair(Rule::r1, std::uint64_t{1}));
  EXPECT_EQ(take(Rule::r3), std::pair(Rule::r2, std::uint64_t{6}));
  EXPECT_EQ(take(Rule::r1), std::pair(Rule::r1, std::uint64_t{0})) << "none";
  EXPECT_EQ(take(Rule::r2), std::pair(Rule::r2, std::uint64_t{4}));
  EXPECT_EQ(take(Rule::r2), std::pair(Rule::r2, std::uint64_t{5}));
  EXPECT_EQ(take(Rule::r2), std::pair(Rule::r1, std::uint64_t{0})) << "R3 is not asked for";
  EXPECT_EQ(take(Rule::r3), std::pair(Rule::r3, std::uint64_t{1}));
  EXPECT_EQ(queue.size(), 0U);
}

TEST_F(RefinerTest, OfAPartLeavesWhatReachesBeyondForLater) {
  const UniformSize coarse(1.5);  // at first there are tets from one end to the other
  refiner(Rules(coarse, {}), 100'000).run(Rule::r3, never);
  const Triangulation& t = t_.triangulation();
  VertexParts parts(t.vertex_slots() + 1000, 0);
  for (PointId v = Triangulation::kCorners; v < t.vertex_slots(); ++v) parts[v] = t.point(v).x < 0 ? 0 : 1;
  std::vector<Violation> all = violations(rules_);
  const std::uint64_t before = t_.vertex_count();
  Editor editor(t_, parts, 0, 200);
  broken_.assign(t_.balls().slots(), 0);
  Refiner part(t_, rules_, std::move(editor), broken_, 200);
  broken_.resize(t_.balls().slots());
  for (const Violation& violation : all) {
    const FacetCode code = violation.rule == Rule::r3 ? 4 * violation.element : t_.balls()[violation.element].facet;
    if (parts[facet_vertices(t.cell(code / 4), static_cast<int>(code % 4))[0]] == 0) part.push(violation);
  }
  part.run(Rule::r3, never);
  for (PointId v = Triangulation::kCorners; v < t.vertex_slots(); ++v) {
    EXPECT_FALSE(t.is_vertex(v) && parts[v] == 0 && t.point(v).x > 2.5) << "inserted where the part is";
  }
  std::vector<Violation> left;
  std::vector<Violation> given_up;
  part.retire(left, given_up);
  EXPECT_GT(t_.vertex_count(), before);
  EXPECT_FALSE(left.empty());
  EXPECT_TRUE(std::any_of(left.begin(), left.end(), [&](const Violation& v) { return v.alive(t_); }));
  refiner(rules_, 100'000).run(Rule::r3, never);
  EXPECT_EQ(count(rules_, Rule::r3), 0U);
}

}  // namespace
}  // namespace scantet::engine
