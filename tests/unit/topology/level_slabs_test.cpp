#include "scantet/topology/level_slabs.h"

#include <gtest/gtest.h>

#include "scantet/field/level_settings.h"
#include "unit/image/test_scan.h"

namespace scantet {
namespace {

/// In 80 layers, which are several slabs: a rod through most of them, and a ball in one.
Scan rod_and_ball() {
  return test::scan_of_function<std::int16_t>({20, 9, 80}, [](int i, int j, int k) {
    const bool in_rod = std::abs(i - 4) < 2 && std::abs(j - 4) < 2 && k > 4 && k < 75;
    return in_rod || distance({14, 4, 40}, {double(i), double(j), double(k)}) < 2.5 ? 10 : -10;
  });
}

TEST(LevelSlabs, SewnTogetherMeasureComponentsThatReachThroughSeveral) {
  const std::unique_ptr<HeightGrid> heights = make_height_grid(rod_and_ball(), {0, InsideSide::above, {}});
  std::vector<LevelSlab> slabs = make_level_slabs(*heights, Progress());
  ASSERT_GT(slabs.size(), 2U);
  for (std::size_t n = 0; n + 1 < slabs.size(); ++n) EXPECT_EQ(slabs[n].last, slabs[n + 1].first);
  const std::vector<Measure> measures = sew(slabs);
  ASSERT_EQ(measures.size(), 3U) << "the unbounded outside, and the two";
  const Measure& rod = measures[1].nodes > measures[2].nodes ? measures[1] : measures[2];
  EXPECT_EQ(rod.nodes, 9 * 70);
  EXPECT_EQ(rod.low[2], 5);
  EXPECT_EQ(rod.high[2], 74);
  for (const Measure& measure : {measures[1], measures[2]}) {
    EXPECT_TRUE(measure.inside);
    EXPECT_EQ(measure.eighths, 8) << "a ball";
  }
}

TEST(LevelSlabs, VisitsEachNodeOnceInOrder) {
  const std::unique_ptr<HeightGrid> heights = make_height_grid(rod_and_ball(), {0, InsideSide::above, {}});
  std::int64_t nodes = 0;
  std::array<int, 3> last{-1, 0, 10};  // z, y, x
  visit_runs(*heights, 10, 20, Progress(), [&](int begin, int end, int j, int k, int side, std::uint32_t) {
    EXPECT_LT(last, (std::array<int, 3>{k, j, begin}));
    EXPECT_EQ(heights->height(begin, j, k) > 0, side > 0);
    last = {k, j, begin};
    nodes += end - begin;
  });
  EXPECT_EQ(nodes, 20 * 9 * 10);
}

}  // namespace
}  // namespace scantet
