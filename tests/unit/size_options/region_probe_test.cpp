#include "scantet/size_options/region_probe.h"

#include <gtest/gtest.h>

#include "unit/nested_balls.h"

namespace scantet {
namespace {

/// The same without its list of components.
class UnlistedBalls final : public Domain {
 public:
  Box bounds() const override { return balls_.bounds(); }
  Region region_at(const Point& p) const override { return balls_.region_at(p); }
  void crossings(const Segment& segment, Crossings& out) const override { balls_.crossings(segment, out); }

 private:
  test::NestedBalls balls_{5, 10};
};

TEST(RegionProbe, ReadsTheDomainsListOfComponents) {
  EXPECT_EQ(regions_of(test::NestedBalls(5, 10)), (std::set<Region>{1, 2}));
}

TEST(RegionProbe, FindsRegionsAlongTheBoundaryWhereThereIsNoList) {
  EXPECT_EQ(regions_of(UnlistedBalls()), (std::set<Region>{1, 2}));
  EXPECT_EQ(regions_of(*make_sphere({}, 3)), (std::set<Region>{1}));
}

TEST(RegionProbe, ABoundaryPointCountsToARegionBesideIt) {
  const test::NestedBalls balls(5, 10);
  for (const Vec& direction : {Vec{1, 0, 0}, Vec{0, 0, -1}, Vec{0.6, 0.8, 0}}) {
    EXPECT_EQ(region_beside(balls, 10 * direction, 0.1), 1);
    EXPECT_GT(region_beside(balls, 5 * direction, 0.1), 0);
    EXPECT_EQ(region_beside(balls, 12 * direction, 0.1), kOutside);
  }
}

TEST(RegionProbe, TheFirstLookIsAShareOfTheLongestSide) {
  EXPECT_NEAR(first_look_mm(*make_sphere({}, 64)), 1, 0.1);
}

}  // namespace
}  // namespace scantet
