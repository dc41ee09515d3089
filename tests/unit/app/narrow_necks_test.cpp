// Two blocks hang together by a neck that is a thousandth of the elements wide.
#include "scantet/app/narrow_necks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scantet/image/level_set.h"
#include "unit/image/test_scan.h"
#include "unit/solids.h"

namespace scantet {
namespace {

const Point kNeck{5.5, 5.5, 5};  // between the nodes where the blocks are next to each other

/// around: below 0 where no block is; with -1 the blocks would just touch.
std::unique_ptr<Domain> two_blocks(double around) {
  const Scan scan = test::scan_of_function<float>({12, 12, 12}, [&](int i, int j, int k) {
    const bool in_first = std::min({i, j, k}) >= 2 && std::max({i, j, k}) <= 5;
    const bool in_second = std::min({i, j, k + 1}) >= 6 && std::max({i, j, k + 1}) <= 9;
    return in_first || in_second ? 1.0 : around;
  });
  return make_level_set(scan, {0, InsideSide::above, std::nullopt});
}

TEST(NarrowNecks, AreFoundOnceNearAPlace) {
  const auto domain = two_blocks(-0.999);
  const UniformSize size(3);
  NarrowNecks necks(*domain, size);
  EXPECT_FALSE(necks.add_near({}));
  EXPECT_FALSE(necks.add_near(std::vector<Point>{{2, 2, 2}})) << "more than a size away";
  const std::vector<Point> beside{kNeck + Vec{1, 0, 1}, kNeck};
  EXPECT_TRUE(necks.add_near(beside));
  ASSERT_EQ(necks.places().size(), 1U);
  const FinerPlace& place = necks.places().front();
  EXPECT_LT(distance(place.point, kNeck), 1e-3);
  EXPECT_LT(place.size_mm, 0.01 * 3);
  EXPECT_FALSE(necks.add_near(beside)) << "it is known";
}

TEST(NarrowNecks, OfSomeWidthGetNoSize) {
  const auto domain = two_blocks(-0.5);
  const UniformSize size(3);
  NarrowNecks necks(*domain, size);
  EXPECT_FALSE(necks.add_near(std::vector<Point>{kNeck}));
  EXPECT_TRUE(necks.places().empty());
}

TEST(NarrowNecks, ADomainWithoutHintsHasNone) {
  const test::Solids ball({{{0, 0, 0}, 2}}, {});
  const UniformSize size(1);
  NarrowNecks necks(ball, size);
  EXPECT_FALSE(necks.add_near(std::vector<Point>{{2, 0, 0}}));
}

}  // namespace
}  // namespace scantet
