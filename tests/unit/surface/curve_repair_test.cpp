// A curve on a ball, around a piece of which tets change sides.
#include "scantet/domain/analytic.h"
#include "scantet/surface/curve_repair_impl.h"
#include "unit/surface/samples.h"

namespace scantet::engine {
namespace {

constexpr double kBallMm = 0.4;  // around the ends of the piece
const Point kStart{4, 0, 0};
const Point kEnd{4 * std::cos(0.15), 4 * std::sin(0.15), 0};
const Point kFar{-4, 0, 0};

class CurveRepairTest : public testing::Test {
 protected:
  CurveRepairTest() : ball_(make_sphere({}, 4)), restricted_(triangulated(*ball_, sample())) {
    const PointId first = Triangulation::kCorners;
    const std::vector<Region> regions{kOutside, 1};
    restricted_.set_junctions(Junctions({{regions}, {regions}, {regions}},
                                        {{{first, first + 1}, regions}, {{first + 1, first + 2}, regions}}));
  }

  std::vector<SamplePoint> sample() const {
    std::vector<SamplePoint> points;
    for (const Point& p : {kStart, kEnd, kFar}) points.push_back({p, 1, {}, kBallMm * kBallMm});
    const std::vector<SamplePoint> others = sparse_sample(*ball_, 0.7, 1);
    points.insert(points.end(), others.begin(), others.end());
    return points;
  }
  std::unique_ptr<Domain> ball_;
  RestrictedTriangulation restricted_;
};

TEST_F(CurveRepairTest, AsksForNothingWhereTheRegionsAreRight) {
  EXPECT_TRUE(CurveRepair(*ball_, restricted_).points_beside().empty()) << "ends far from each other are no edge";
}

TEST_F(CurveRepairTest, AsksForPointsOfThePatchesWhereARegionIsMissed) {
  turn(restricted_, 1, [](const Point&) { return true; });
  const std::vector<ExtraPoint> points = CurveRepair(*ball_, restricted_).points_beside();
  ASSERT_FALSE(points.empty());
  for (const ExtraPoint& extra : points) {
    EXPECT_NEAR(distance(extra.point, {}), 4, 1e-9);
    EXPECT_NEAR(distance(extra.point, lerp(kStart, kEnd, 0.5)), kBallMm, 0.1 * kBallMm);
    EXPECT_GT(extra.clear_mm, 0);
    EXPECT_LE(extra.clear_mm, 0.5 * kBallMm);
  }
}

}  // namespace
}  // namespace scantet::engine
