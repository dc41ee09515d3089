// Maps of regions around one vertex.
#include "scantet/surface/boundary_link_impl.h"
#include "scantet/surface/region_star_impl.h"
#include "unit/surface/ring_star.h"
#include "unit/surface/samples.h"

namespace scantet::engine {
namespace {

class RegionStar : public RingStar {
 protected:
  StarFault fault(const std::function<Region(int, bool)>& region_of) {
    set_regions(region_of);
    return fault_of_star(t_, middle_, star_);
  }
};

TEST_F(RegionStar, HasTheTetsItIsBuiltFor) {
  EXPECT_EQ(star_.size(), 2U * kRing);
}

TEST_F(RegionStar, OneRegionHasNoFault) {
  EXPECT_EQ(fault([](int, bool) { return 1; }), StarFault::none);
}

TEST_F(RegionStar, TwoRegionsMeetInADisk) {
  EXPECT_EQ(fault([](int, bool above) { return above ? 1 : 0; }), StarFault::none);
  EXPECT_EQ(fault([](int sector, bool) { return sector < 5 ? 1 : 0; }), StarFault::none);
}

TEST_F(RegionStar, ThreeRegionsMeetInACurve) {
  EXPECT_EQ(fault([](int sector, bool) { return sector / 4; }), StarFault::none);
}

TEST_F(RegionStar, FourRegionsMeetInACorner) {
  EXPECT_EQ(fault([](int sector, bool above) { return above ? sector / 4 : 3; }), StarFault::none);
}

TEST_F(RegionStar, TetsThatMeetInAnEdgeAreAPinch) {
  EXPECT_EQ(fault([](int sector, bool) { return sector / 3 % 2; }), StarFault::split_region);
}

TEST_F(RegionStar, ConesThatMeetInTheirApexAreAPinch) {
  EXPECT_EQ(fault([](int sector, bool above) { return sector == 0 && above    ? 1
                                                      : sector == 6 && !above ? 1
                                                                              : 0; }),
            StarFault::split_region);
}

TEST_F(RegionStar, ARegionAroundAnotherIsNoBall) {
  // Region 1 is a belt between 2 above and 3 below.
  const auto belt = [](int sector, bool above) { return above ? (sector % 2 == 0 ? 2 : 1) : 1; };
  EXPECT_NE(fault(belt), StarFault::none);
}

TEST_F(RegionStar, TwoRegionsThatMeetTwiceAroundTwoOthersAreAFault) {
  // Around the axis 0, 1, 0 would be split; 0 and 1 meet in two places when 2 and 3 part them at both ends.
  const auto map = [](int sector, bool above) {
    if (sector < 4) return above ? 0 : 1;
    if (sector < 6) return 2;
    if (sector < 10) return above ? 0 : 1;
    return 3;
  };
  EXPECT_NE(fault(map), StarFault::none);
}

TEST_F(RegionStar, CheckDisksAsksItAtCurvesOnly) {
  fault([](int sector, bool) { return sector / 4; });
  const auto facets = [&] { return boundary_facets(t_); };
  const auto is_broken = [&] {
    DiskNotes notes;
    notes.grow(t_.vertex_slots());
    const std::vector<PointId> broken = check_all_disks(t_, notes, facets);
    return std::find(broken.begin(), broken.end(), middle_) != broken.end();
  };
  EXPECT_TRUE(is_broken()) << "three regions do not meet on a patch";
  t_.vertex_info(middle_).dimension = 1;
  EXPECT_FALSE(is_broken());
}

}  // namespace
}  // namespace scantet::engine
