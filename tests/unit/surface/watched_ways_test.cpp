// Ways through a ball, some of whose tets change sides.
#include <algorithm>

#include "scantet/domain/analytic.h"
#include "scantet/surface/watched_ways_impl.h"
#include "unit/surface/samples.h"

namespace scantet::engine {
namespace {

/// A ball that tells of ways.
class BallWithWays : public Domain {
 public:
  Box bounds() const override { return ball_->bounds(); }
  Region region_at(const Point& p) const override { return ball_->region_at(p); }
  void crossings(const Segment& segment, Crossings& out) const override { ball_->crossings(segment, out); }
  void surface_candidates(double spacing_mm, const PointSink& sink) const override {
    ball_->surface_candidates(spacing_mm, sink);
  }
  void narrow_ways(LevelGround, const NarrowWaySink& sink) const override {
    for (const NarrowWay& way : ways) sink(way);
  }

  std::vector<NarrowWay> ways{
      {1, {{-3, 0.1, 0.2}, {0, 0.2, 0.1}}},
      {1, {{0, 0.2, 0.1}, {3, 0.1, 0.1}}},
      {1, {{0.1, -2, -2}, {0.1, 2, 2}}},
  };

 private:
  std::unique_ptr<Domain> ball_ = make_sphere({}, 4);
};

class WatchedWaysTest : public testing::Test {
 protected:
  WatchedWaysTest() : restricted_(triangulated(ball_, sparse_sample(ball_, 0.7, 1))) {}

  Triangulation& t() { return restricted_.triangulation(); }
  CellId cell_at(const Point& p) {
    CellId c = 0;
    while (!t().is_cell(c) || t().has_corner(c) || !holds(t(), c, p)) ++c;
    return c;
  }

  BallWithWays ball_;
  RestrictedTriangulation restricted_;
};

TEST_F(WatchedWaysTest, ATetOfAnotherRegionIsFoundAndNoMoreWhenItIsBack) {
  WatchedWays watched(t());
  EXPECT_TRUE(watched.wrong(ball_.ways).empty());
  const Point place = ball_.ways[2].segment.source;
  const CellId cell = cell_at(place);
  restricted_.change_side(cell, kOutside);
  for (int look = 0; look < 2; ++look) {
    const std::vector<WrongTet> wrong = watched.wrong(ball_.ways);
    ASSERT_EQ(wrong.size(), 1U);
    EXPECT_EQ(wrong[0].cell, cell);
    EXPECT_TRUE(holds(t(), cell, wrong[0].place));
  }
  restricted_.change_side(cell, 1);
  EXPECT_TRUE(watched.wrong(ball_.ways).empty());
}

TEST_F(WatchedWaysTest, ATetOnSeveralWaysIsListedOnce) {
  restricted_.change_side(cell_at(ball_.ways[0].segment.target), kOutside);
  WatchedWays watched(t());
  EXPECT_EQ(watched.wrong(ball_.ways).size(), 1U);
}

TEST_F(WatchedWaysTest, TetsThatHaveComeInPlaceOfOthersAreLookedAt) {
  WatchedWays watched(t());
  ASSERT_TRUE(watched.wrong(ball_.ways).empty());
  insert(restricted_, {0.5, 0.3, 0.2});
  const CellId cell = cell_at(ball_.ways[0].segment.target);
  restricted_.change_side(cell, kOutside);
  const std::vector<WrongTet> wrong = watched.wrong(ball_.ways);
  EXPECT_TRUE(std::any_of(wrong.begin(), wrong.end(), [&](const WrongTet& w) { return w.cell == cell; }));
}

TEST(AgreedWays, AreThoseThatLieInTheirRegions) {
  BallWithWays ball;
  const std::size_t right = ball.ways.size();
  ball.ways.push_back({1, {{0, 0, 0}, {5, 0, 0}}});         // leaves the ball
  ball.ways.push_back({kOutside, {{1, 1, 0}, {0, 1, 1}}});  // is in it
  ball.ways.push_back({kOutside, {{6, 0, 0}, {6, 1, 0}}});  // is not
  const auto ways = agreed_ways(ball, LevelGround::ends_ways);
  EXPECT_EQ(ways.size(), right + 1);
  for (const NarrowWay& way : ways) EXPECT_EQ(ball.region_at(way.segment.target), way.region);
}

}  // namespace
}  // namespace scantet::engine
