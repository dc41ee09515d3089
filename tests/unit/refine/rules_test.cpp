// Each criterion alone, on either side of what it measures.
#include <cmath>
#include <limits>

#include "scantet/delaunay/circumcentre.h"
#include "scantet/domain/analytic.h"
#include "scantet/refine/rules_impl.h"
#include "unit/surface/samples.h"

namespace scantet::engine {
namespace {

constexpr double kInfinite = 1e100;

class RulesTest : public testing::Test {
 protected:
  RulesTest() : restricted_(triangulated(*torus_, sparse_sample(*torus_, 0.6, 9))), t_(restricted_.triangulation()) {
    for_each_inner_facet(t_, [&](FacetCode facet) {
      const std::uint32_t ball = t_.info(facet / 4).balls[facet % 4];
      if (ball != kNone) balls_.push_back(ball);
    });
  }

  /// Options that nothing breaks.
  static MesherOptions lenient() {
    MesherOptions options;
    options.bounds = {
        .facet_radius_edge = kInfinite, .cell_radius_edge = kInfinite, .facet_distance_mm = {}, .small_slack = 1};
    return options;
  }
  std::optional<Violation> facet(std::uint32_t ball, const MesherOptions& options, double size_mm = kInfinite) const {
    const UniformSize size(size_mm);
    return Rules(size, options).facet(restricted_, ball);
  }
  std::optional<Violation> tet(CellId c, const MesherOptions& options, double size_mm = kInfinite) const {
    const UniformSize size(size_mm);
    return Rules(size, options).tet(restricted_, c);
  }
  std::array<PointId, 3> vertices_of(std::uint32_t ball) const {
    const FacetCode facet = restricted_.balls()[ball].facet;
    return facet_vertices(t_.cell(facet / 4), static_cast<int>(facet % 4));
  }
  double largest_radius(std::uint32_t ball) const {
    double largest = 0;
    for (; ball != kNone; ball = restricted_.balls()[ball].next) {
      largest = std::max(largest, restricted_.balls()[ball].radius);
    }
    return largest;
  }

  std::unique_ptr<Domain> torus_ = make_torus({}, 5, 0.7);
  RestrictedTriangulation restricted_;
  Triangulation& t_;
  std::vector<std::uint32_t> balls_;  // the first of each facet
};

TEST_F(RulesTest, NothingIsBrokenByBoundsWithoutEnd) {
  ASSERT_GT(balls_.size(), 50U);
  for (const std::uint32_t ball : balls_) EXPECT_FALSE(facet(ball, lenient()));
  for (CellId c = 0; c < t_.cell_slots(); ++c) EXPECT_FALSE(tet(c, lenient()));
}

TEST_F(RulesTest, R1AsksForVerticesOnTheBoundary) {
  t_.vertex_info(vertices_of(balls_[7])[1]).dimension = 3;
  const auto violation = facet(balls_[7], lenient());
  ASSERT_TRUE(violation);
  EXPECT_EQ(violation->rule, Rule::r1);
  EXPECT_EQ(violation->rank, largest_radius(balls_[7]));
  EXPECT_TRUE(violation->alive(restricted_));
  t_.vertex_info(vertices_of(balls_[7])[1]).dimension = 1;  // a curve is on ∂O, too
  EXPECT_FALSE(facet(balls_[7], lenient()));
}

TEST_F(RulesTest, R1AsksForAShape) {
  std::size_t others = 0;
  for (const std::uint32_t ball : balls_) {
    const auto v = vertices_of(ball);
    const double shape = radius_edge(t_.point(v[0]), t_.point(v[1]), t_.point(v[2]));
    MesherOptions options = lenient();
    options.bounds.facet_radius_edge = 1.0001 * shape;
    EXPECT_FALSE(facet(ball, options));
    options.bounds.facet_radius_edge = 0.9999 * shape;
    const auto violation = facet(ball, options);
    ASSERT_TRUE(violation);
    EXPECT_EQ(violation->rule, Rule::r1);
    EXPECT_EQ(restricted_.balls()[violation->element].radius, largest_radius(ball)) << "the largest ball's centre";
    others += violation->element != ball ? 1 : 0;
  }
  EXPECT_GT(others, 0U) << "it is not always the first";
}

TEST_F(RulesTest, R1AsksForLessOfSmallFacets) {
  const std::uint32_t ball = balls_[3];
  const auto v = vertices_of(ball);
  const Point& corner = t_.point(v[0]);
  const double radius = distance(circumcentre(corner, t_.point(v[1]), t_.point(v[2])), corner);
  MesherOptions options = lenient();
  options.bounds.facet_radius_edge = 0.9 * radius_edge(corner, t_.point(v[1]), t_.point(v[2]));
  options.bounds.small_slack = 1.2;
  const double most = std::max(1.99 * radius, 1.0001 * largest_radius(ball));  // R2 is to find nothing
  ASSERT_LT(most, 2 * radius);
  EXPECT_TRUE(facet(ball, options, most));
  EXPECT_FALSE(facet(ball, options, 2.01 * radius)) << "small";
  options.bounds.small_slack = 1.1;
  EXPECT_TRUE(facet(ball, options, 2.01 * radius)) << "small, but not as well shaped as that";
}

TEST_F(RulesTest, R1AsksForOnePatchUnlessTheBallIsTiny) {
  const std::uint32_t ball = balls_[11];
  t_.vertex_info(vertices_of(ball)[2]).patch.components = {0, 7};
  const double tiny = largest_radius(ball) / 1e-3;
  ASSERT_TRUE(facet(ball, lenient(), 0.999 * tiny));
  EXPECT_EQ(facet(ball, lenient(), 0.999 * tiny)->rule, Rule::r1);
  EXPECT_FALSE(facet(ball, lenient(), 1.001 * tiny));
  t_.vertex_info(vertices_of(ball)[2]).patch = restricted_.balls()[ball].patch;
  restricted_.balls()[ball].patch.components = {0, 7};
  EXPECT_TRUE(facet(ball, lenient(), 0.999 * tiny)) << "balls count as vertices do";
}

TEST_F(RulesTest, R1LeavesComponentsThatAreCloseWhenTold) {
  const std::uint32_t ball = balls_[11];
  const UniformSize far(largest_radius(ball) / 0.101);
  const UniformSize close(largest_radius(ball) / 0.099);
  const auto r1 = [&](const SizingField& size, bool leaves_close) {
    Rules rules(size, lenient());
    if (leaves_close) rules.leave_close();
    return rules.facet(restricted_, ball);
  };
  Patch& patch = t_.vertex_info(vertices_of(ball)[2]).patch;
  const Patch own = patch;
  patch.components = {0, 7};
  ASSERT_TRUE(r1(far, false));
  EXPECT_FALSE(r1(far, false)->is_close);
  EXPECT_TRUE(r1(far, true));
  ASSERT_TRUE(r1(close, false));
  EXPECT_TRUE(r1(close, false)->is_close);
  EXPECT_FALSE(r1(close, true));
  patch = own;
  patch.regions[1] = own.regions[1] + 1;
  ASSERT_TRUE(r1(close, true)) << "boundaries of other regions do not touch";
  EXPECT_FALSE(r1(close, true)->is_close);
}

TEST_F(RulesTest, R2BoundsBallsByAlphaTimesTheSize) {
  for (const std::uint32_t ball : balls_) {
    const double radius = largest_radius(ball);
    MesherOptions options = lenient();
    options.bounds.alpha = 0.5;
    EXPECT_FALSE(facet(ball, options, 2.0001 * radius));
    const auto violation = facet(ball, options, radius);
    ASSERT_TRUE(violation);
    EXPECT_EQ(violation->rule, Rule::r2);
    EXPECT_NEAR(violation->rank, 2, 1e-12) << "times what is allowed";
    EXPECT_EQ(restricted_.balls()[violation->element].radius, radius);
    EXPECT_EQ(violation->cell(restricted_), restricted_.balls()[ball].facet / 4);
  }
}

TEST_F(RulesTest, R2BoundsTheDistanceOfTheFacet) {
  std::size_t asked = 0;
  for (const std::uint32_t ball : balls_) {
    if (restricted_.balls()[ball].next != kNone) continue;
    const auto v = vertices_of(ball);
    const Point flat = circumcentre(t_.point(v[0]), t_.point(v[1]), t_.point(v[2]));
    const double off_mm = distance(flat, restricted_.balls()[ball].center);
    MesherOptions options = lenient();
    options.bounds.facet_distance_mm = 1.0001 * off_mm;
    EXPECT_FALSE(facet(ball, options));
    options.bounds.facet_distance_mm = 0.5 * off_mm;
    const auto violation = facet(ball, options);
    ASSERT_TRUE(violation);
    EXPECT_EQ(violation->rule, Rule::r2);
    EXPECT_NEAR(violation->rank, 2, 1e-9);
    ++asked;
  }
  EXPECT_GT(asked, 20U);
}

TEST_F(RulesTest, R3BoundsSizeAndShapeOfTetsInside) {
  std::size_t asked = 0;
  for (CellId c = 0; c < t_.cell_slots(); ++c) {
    const std::array<Point, 4> p = t_.points_of(c);
    const double radius = distance(t_.cell(c).circumcentre, p[0]);
    const double shape = radius / std::sqrt(squared_shortest_edge(p));
    MesherOptions options = lenient();
    if (t_.info(c).region == kOutside) {
      options.bounds.cell_radius_edge = 1e-3;
      EXPECT_FALSE(tet(c, options, 1e-3));
      continue;
    }
    ++asked;
    EXPECT_FALSE(tet(c, options, 1.0001 * radius));
    const auto large = tet(c, options, 0.5 * radius);
    ASSERT_TRUE(large);
    EXPECT_EQ(large->rule, Rule::r3);
    EXPECT_EQ(large->element, c);
    EXPECT_NEAR(large->rank, 4, 1e-9) << "squared";
    options.bounds.cell_radius_edge = 1.0001 * shape;
    EXPECT_FALSE(tet(c, options));
    options.bounds.cell_radius_edge = shape / 3;
    const auto thin = tet(c, options);
    ASSERT_TRUE(thin);
    EXPECT_NEAR(thin->rank, 9, 1e-9);
    options.bounds.small_slack = 2;
    EXPECT_NEAR(tet(c, options, 1.9 * radius).value().rank, 9, 1e-9) << "not small";
    EXPECT_NEAR(tet(c, options, 2.1 * radius).value().rank, 9.0 / 4, 1e-9) << "small";
    options.bounds.small_slack = 3.001;
    EXPECT_FALSE(tet(c, options, 2.1 * radius));
  }
  EXPECT_GT(asked, 20U);
}

/// A size that is for the boundary only.
class BoundarySize final : public SizingField {
 public:
  double size_at(const Point&) const override { return 1e-3; }
  double min_size() const override { return 1e-3; }
  bool bounds_tets() const override { return false; }
};

TEST_F(RulesTest, R3LeavesTheSizeToFieldsThatBoundTets) {
  const BoundarySize size;
  const Rules rules(size, lenient());
  for (CellId c = 0; c < t_.cell_slots(); ++c) EXPECT_FALSE(rules.tet(restricted_, c));
  EXPECT_TRUE(rules.facet(restricted_, balls_[0]));
}

}  // namespace
}  // namespace scantet::engine
