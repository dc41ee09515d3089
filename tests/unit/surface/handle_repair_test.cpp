// A torus that tells of the way around it, with a sample too sparse to show that.
#include <numbers>

#include "scantet/domain/analytic.h"
#include "scantet/surface/handle_repair_impl.h"
#include "unit/surface/samples.h"

namespace scantet::engine {
namespace {

constexpr int kWayRounds = 30;
constexpr HandleRepair::Care kCare{.most_broken = 1, .way_rounds = kWayRounds};
constexpr double kMajor = 5;
constexpr double kMinor = 0.7;

class TorusWithWays : public Domain {
 public:
  Box bounds() const override { return torus_->bounds(); }
  Region region_at(const Point& p) const override { return torus_->region_at(p); }
  void crossings(const Segment& segment, Crossings& out) const override { torus_->crossings(segment, out); }
  void surface_candidates(double spacing_mm, const PointSink& sink) const override {
    torus_->surface_candidates(spacing_mm, sink);
  }
  void narrow_ways(LevelGround, const NarrowWaySink& sink) const override {
    constexpr int kSteps = 40;
    for (int ring = 0; ring < rings; ++ring) {
      const double off = 0.16 * kMinor * (ring % 5);
      const auto at = [&](int n) {
        const double angle = 2 * std::numbers::pi * n / kSteps;
        const double r = kMajor + off * std::cos(ring);
        return Point{r * std::cos(angle), r * std::sin(angle), off * std::sin(ring)};
      };
      for (int n = 0; n < kSteps; ++n) sink({1, {at(n), at(n + 1)}});
    }
  }
  std::vector<Misplaced> misplaced(const MeshBoundary&, const PlaceFilter&) const override {
    ++asked_for_places;
    return places;
  }

  std::vector<Component> components() const override {
    Component whole;
    whole.region = 1;
    whole.euler = euler;
    whole.surfaces = surfaces;
    return {whole};
  }

  int rings = 1;                          // of ways, the first in the middle of the body
  std::optional<std::int64_t> euler = 0;  // as told
  std::optional<std::uint64_t> surfaces;
  std::vector<Misplaced> places;
  mutable int asked_for_places = 0;

 private:
  std::unique_ptr<Domain> torus_ = make_torus({}, kMajor, kMinor);
};

/// Dense, but for a bow in which few points show that the ring goes on.
std::vector<SamplePoint> sample_with_gap(const Domain& torus) {
  std::vector<SamplePoint> sample = sparse_sample(torus, 0.25, 1);
  std::size_t count = 0;
  std::erase_if(sample,
                [&](const SamplePoint& p) { return p.point.x > 0 && std::abs(p.point.y) < 1.5 && count++ % 60 != 0; });
  return sample;
}

/// The share of points on the ways that are in tets of the inside, found by a look at each tet.
double share_inside(const Domain& domain, const Triangulation& t) {
  int points = 0;
  int inside = 0;
  domain.narrow_ways(LevelGround::ends_ways, [&](const NarrowWay& way) {
    const Point p = way.segment.source + 0.3 * (way.segment.target - way.segment.source);
    ++points;
    for (CellId c = 0; c < t.cell_slots(); ++c) {
      if (!t.is_cell(c) || t.has_corner(c)) continue;
      if (!holds(t, c, p)) continue;
      inside += t.info(c).region == 1 ? 1 : 0;
      break;
    }
  });
  return double(inside) / points;
}

TEST(HandleRepair, PointsBringTheWaysInside) {
  const TorusWithWays torus;
  RestrictedTriangulation t = triangulated(torus, sample_with_gap(torus));
  ASSERT_LT(share_inside(torus, t.triangulation()), 1) << "the sample is too sparse";
  const UniformSize size(2);
  int rounds = 0;
  std::size_t added = 0;
  KnownBoundary boundary(t);
  HandleRepair repair(torus, t, boundary, size, 1, kCare);
  for (std::vector<ExtraPoint> points = repair.missing_points(); !points.empty() && rounds < 30;
       points = repair.missing_points()) {
    ++rounds;
    added += points.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_TRUE(torus.patch_at(points[i].point).is_known()) << "on the boundary";
      EXPECT_GT(points[i].clear_mm, 0);
      EXPECT_TRUE(i == 0 || points[i].clear_mm <= points[i - 1].clear_mm) << "the clearest first";
      insert(t, points[i].point);
    }
  }
  EXPECT_GT(added, 0U);
  EXPECT_EQ(share_inside(torus, t.triangulation()), 1);
}

/// Of a repair that has not been asked before.
std::vector<ExtraPoint> first_points(const Domain& domain, std::vector<SamplePoint> sample) {
  RestrictedTriangulation t = triangulated(domain, std::move(sample));
  const UniformSize size(2);
  KnownBoundary boundary(t);
  return HandleRepair(domain, t, boundary, size, 1, kCare).missing_points();
}

TEST(HandleRepair, HasNothingToAddToASurfaceWellSampled) {
  const TorusWithWays torus;
  EXPECT_TRUE(first_points(torus, sparse_sample(torus, 0.3, 1)).empty());
  EXPECT_EQ(torus.asked_for_places, 0);
}

TEST(HandleRepair, TellsOfHandlesThatSeemToBeExchangedWhereTheEulerNumberIsRightAndWrongWhereItIsNot) {
  TorusWithWays torus;
  torus.places = {{{kMajor, 0, 0}, kOutside, 0}, {{kMajor + 0.1, 0, 0}, kOutside, 0}, {{0, kMajor, 0}, kOutside, 1}};
  RestrictedTriangulation t = triangulated(torus, sparse_sample(torus, 0.3, 1));
  KnownBoundary boundary(t);
  const UniformSize size(2);
  EXPECT_EQ(HandleRepair(torus, t, boundary, size, 1, kCare).exchanged_places().size(), 2U) << "one a group";
  EXPECT_TRUE(HandleRepair(torus, t, boundary, size, 1, kCare).wrong_places().empty());
  torus.euler = 2;
  EXPECT_EQ(HandleRepair(torus, t, boundary, size, 1, kCare).wrong_places().size(), 2U) << "one a group";
  EXPECT_TRUE(HandleRepair(torus, t, boundary, size, 1, kCare).exchanged_places().empty()) << "that is found otherwise";
  torus.euler = 0;
  torus.surfaces = 0;
  torus.asked_for_places = 0;
  EXPECT_TRUE(HandleRepair(torus, t, boundary, size, 1, kCare).exchanged_places().empty()) << "no handle, none to lose";
  EXPECT_EQ(torus.asked_for_places, 0);
}

TEST(HandleRepair, AsksForPlacesWhereTheEulerNumberIsAnotherAndAllWaysAreRight) {
  TorusWithWays torus;
  torus.euler = 2;
  EXPECT_TRUE(first_points(torus, sparse_sample(torus, 0.3, 1)).empty());
  EXPECT_EQ(torus.asked_for_places, 1);
}

TEST(HandleRepair, GivesUpWhereTooManyWaysAreBrokenUnlessFewHandlesAreWrongAndItMayKeepThem) {
  TorusWithWays torus;
  torus.rings = 100;
  torus.places = {{{kMajor, 0, 0}, 1, 0}};
  RestrictedTriangulation t = triangulated(torus, sparse_sample(torus, 0.2, 1));
  turn(t, 1, [](const Point& p) { return p.x > 0; });
  const UniformSize size(2);
  KnownBoundary boundary(t);
  HandleRepair hasty(torus, t, boundary, size, 1, {.way_rounds = kWayRounds});
  EXPECT_TRUE(hasty.missing_points().empty());
  EXPECT_TRUE(hasty.are_too_many());
  HandleRepair thorough(torus, t, boundary, size, 1, {.keeps_few = true, .way_rounds = kWayRounds});
  EXPECT_FALSE(thorough.missing_points().empty()) << "at the place, not on the ways";
  EXPECT_FALSE(thorough.are_too_many());
  torus.euler = 100;
  HandleRepair hopeless(torus, t, boundary, size, 1, {.keeps_few = true, .way_rounds = kWayRounds});
  EXPECT_TRUE(hopeless.missing_points().empty());
  EXPECT_TRUE(hopeless.are_too_many());
}

TEST(HandleRepair, SeeksFalseHandlesWhereTheEulerNumberIsRightIfAsked) {
  TorusWithWays torus;
  RestrictedTriangulation restricted = triangulated(torus, sparse_sample(torus, 0.3, 1));
  turn(restricted, kOutside, [](const Point& p) { return std::abs(p.x) < 1 && std::abs(p.y) < kMajor; });
  const UniformSize size(4);
  KnownBoundary boundary(restricted);
  torus.euler = boundary.surfaces().euler_number();
  ASSERT_NE(torus.euler, 0) << "the bridge has made a handle";
  HandleRepair repair(torus, restricted, boundary, size, 1, kCare);
  EXPECT_TRUE(repair.missing_points().empty());
  EXPECT_TRUE(repair.points_on_false_handles().empty());
  repair.begin_again(0, true);
  EXPECT_FALSE(repair.points_on_false_handles().empty());
}

/// So thin beside the sample that dual edges pass through it; it tells of another Euler number than it has.
class ThinRing : public Domain {
 public:
  Box bounds() const override { return ring_->bounds(); }
  Region region_at(const Point& p) const override { return ring_->region_at(p); }
  void crossings(const Segment& segment, Crossings& out) const override { ring_->crossings(segment, out); }
  void surface_candidates(double spacing_mm, const PointSink& sink) const override {
    ring_->surface_candidates(spacing_mm, sink);
  }
  std::vector<Component> components() const override {
    Component whole;
    whole.region = 1;
    whole.euler = 40;
    return {whole};
  }

 private:
  std::unique_ptr<Domain> ring_ = make_torus({}, 5, 0.3);
};

TEST(HandleRepair, AsksForPointsWhereDualEdgesMeetTheBoundaryAgainAsLongAsThatHelps) {
  const ThinRing ring;
  RestrictedTriangulation t = triangulated(ring, sparse_sample(ring, 1, 1));
  const UniformSize size(2);
  KnownBoundary boundary(t);
  HandleRepair repair(ring, t, boundary, size, 1, kCare);
  EXPECT_GT(repair.wrong_count(), 0U);
  EXPECT_TRUE(repair.points_on_chains().empty()) << "not asked for before";
  EXPECT_TRUE(repair.missing_points().empty()) << "no ways, no places";
  const std::vector<ExtraPoint> points = repair.points_on_chains();
  ASSERT_FALSE(points.empty());
  for (const ExtraPoint& p : points) {
    EXPECT_NEAR(std::hypot(std::hypot(p.point.x, p.point.y) - 5, p.point.z), 0.3, 1e-6) << "on the boundary";
  }
  EXPECT_TRUE(repair.points_on_chains().empty()) << "none was inserted, so there are no fewer";
  EXPECT_TRUE(repair.points_on_chains().empty()) << "and that is the end of it";
}

TEST(HandleRepair, LeavesAllAsItIsWhereTheEulerNumberIsNotKnown) {
  TorusWithWays torus;
  torus.euler = std::nullopt;
  EXPECT_TRUE(first_points(torus, sample_with_gap(torus)).empty());
}

TEST(HandleRepair, PointsBringAskedWaysInsideWhateverTheEulerNumberIs) {
  TorusWithWays torus;
  std::vector<NarrowWay> asked;
  torus.narrow_ways(LevelGround::ends_ways, [&](const NarrowWay& way) { asked.push_back(way); });
  torus.euler = std::nullopt;
  RestrictedTriangulation t = triangulated(torus, sample_with_gap(torus));
  ASSERT_LT(share_inside(torus, t.triangulation()), 1) << "the sample is too sparse";
  const UniformSize size(2);
  KnownBoundary boundary(t);
  HandleRepair repair(torus, t, boundary, size, 1, {.most_broken = 1, .way_rounds = kWayRounds, .asked = asked});
  EXPECT_TRUE(repair.points_on_ways().empty());
  int rounds = 0;
  for (auto points = repair.points_on_asked_ways(); !points.empty(); points = repair.points_on_asked_ways()) {
    ASSERT_LE(++rounds, kWayRounds);
    for (const ExtraPoint& extra : points) insert(t, extra.point);
  }
  EXPECT_GT(rounds, 0);
  EXPECT_EQ(share_inside(torus, t.triangulation()), 1);
}

}  // namespace
}  // namespace scantet::engine
