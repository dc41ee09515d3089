// Maps of regions around one vertex.
#include <map>
#include <random>
#include <set>

#include "scantet/base/union_find.h"
#include "scantet/surface/boundary_link_impl.h"
#include "scantet/surface/region_star_impl.h"
#include "unit/surface/ring_star.h"
#include "unit/surface/samples.h"

namespace scantet::engine {
namespace {

class RegionStar : public RingStar {
 protected:
  bool meet_well(const std::function<Region(int, bool)>& region_of) {
    set_regions(region_of);
    return regions_meet_well(t_, middle_, star_);
  }
};

TEST_F(RegionStar, HasTheTetsItIsBuiltFor) {
  EXPECT_EQ(star_.size(), 2U * kRing);
}

TEST_F(RegionStar, OneRegionHasNoFault) {
  EXPECT_TRUE(meet_well([](int, bool) { return 1; }));
}

TEST_F(RegionStar, TwoRegionsMeetInADisk) {
  EXPECT_TRUE(meet_well([](int, bool above) { return above ? 1 : 0; }));
  EXPECT_TRUE(meet_well([](int sector, bool) { return sector < 5 ? 1 : 0; }));
}

TEST_F(RegionStar, ThreeRegionsMeetInACurve) {
  EXPECT_TRUE(meet_well([](int sector, bool) { return sector / 4; }));
}

TEST_F(RegionStar, FourRegionsMeetInACorner) {
  EXPECT_TRUE(meet_well([](int sector, bool above) { return above ? sector / 4 : 3; }));
}

TEST_F(RegionStar, TetsThatMeetInAnEdgeAreAPinch) {
  EXPECT_FALSE(meet_well([](int sector, bool) { return sector / 3 % 2; }));
}

TEST_F(RegionStar, ConesThatMeetInTheirApexAreAPinch) {
  EXPECT_FALSE(meet_well([](int sector, bool above) { return sector == (above ? 0 : 6) ? 1 : 0; }));
}

TEST_F(RegionStar, ARegionAroundAnotherIsNoBall) {
  // Region 1 is a belt between 2 above and 3 below.
  const auto belt = [](int sector, bool above) { return above ? (sector % 2 == 0 ? 2 : 1) : 1; };
  EXPECT_FALSE(meet_well(belt));
}

TEST_F(RegionStar, TwoRegionsThatMeetTwiceAroundTwoOthersAreAFault) {
  // Around the axis 0, 1, 0 would be split; 0 and 1 meet in two places when 2 and 3 part them at both ends.
  const auto map = [](int sector, bool above) {
    if (sector < 4) return above ? 0 : 1;
    if (sector < 6) return 2;
    if (sector < 10) return above ? 0 : 1;
    return 3;
  };
  EXPECT_FALSE(meet_well(map));
}

/// The same by its definition, part by part.
class ByDefinition {
 public:
  ByDefinition(const Triangulation& t, PointId v, const std::vector<CellId>& star) : t_(t) {
    for (const CellId c : star) {
      tets_of_[t.info(c).region].push_back(c);
      for (std::size_t i = 0; i < 4; ++i) {
        const Region here = t.info(c).region;
        const Region there = t.info(t.cell(c).neighbor[i] / 4).region;
        if (t.cell(c).vertex[i] == v || here >= there) continue;
        std::set<PointId> arc;
        for (std::size_t k = 0; k < 4; ++k) arc.insert(t.cell(c).vertex[k]);
        arc.erase(v);
        arc.erase(t.cell(c).vertex[i]);
        rims_[here].push_back(arc);
        rims_[there].push_back(arc);
        borders_[{here, there}].push_back(arc);
      }
    }
  }
  bool meet_well() const {
    const auto beside = [&](CellId a, CellId b) {
      const auto& next = t_.cell(a).neighbor;
      return std::any_of(next.begin(), next.end(), [&](std::uint32_t code) { return code / 4 == b; });
    };
    const auto touch = [](const std::set<PointId>& a, const std::set<PointId>& b) {
      return std::any_of(a.begin(), a.end(), [&](PointId p) { return b.contains(p); });
    };
    bool well = true;
    for (const auto& [region, tets] : tets_of_) well = well && pieces(tets, beside) == 1;
    for (const auto& [region, arcs] : rims_) well = well && pieces(arcs, touch) == 1 && passes_no_place_twice(arcs);
    for (const auto& [regions, arcs] : borders_) well = well && pieces(arcs, touch) == 1;
    return well;
  }

 private:
  template <class Part, class Joined>
  static std::size_t pieces(const std::vector<Part>& parts, const Joined& joined) {
    UnionFind sets(parts.size());
    std::set<std::uint32_t> roots;
    for (std::uint32_t a = 0; a < parts.size(); ++a) {
      for (std::uint32_t b = 0; b < a; ++b) {
        if (joined(parts[a], parts[b])) sets.unite(a, b);
      }
    }
    for (std::uint32_t a = 0; a < parts.size(); ++a) roots.insert(sets.find(a));
    return roots.size();
  }
  static bool passes_no_place_twice(const std::vector<std::set<PointId>>& arcs) {
    std::map<PointId, int> arcs_at;
    for (const auto& arc : arcs) {
      for (const PointId p : arc) ++arcs_at[p];
    }
    return std::all_of(arcs_at.begin(), arcs_at.end(), [](const auto& at) { return at.second == 2; });
  }

  const Triangulation& t_;
  std::map<Region, std::vector<CellId>> tets_of_;
  std::map<Region, std::vector<std::set<PointId>>> rims_;
  std::map<std::pair<Region, Region>, std::vector<std::set<PointId>>> borders_;
};

TEST_F(RegionStar, IsAsDefinedForAnyMap) {
  std::mt19937 random(5);
  int well = 0;
  constexpr int kMaps = 4000;
  for (int n = 0; n < kMaps; ++n) {
    // Stretches of sectors, above and below, so that some maps are good ones.
    std::array<std::array<Region, kRing>, 2> map{};
    for (auto& half : map) {
      for (std::size_t s = 0; s < half.size(); ++s) {
        half[s] = s > 0 && random() % 4 != 0 ? half[s - 1] : static_cast<Region>(random() % 4);
      }
    }
    if (random() % 2 == 0) map[1] = map[0];
    const bool found = meet_well([&](int sector, bool above) { return map[above ? 1 : 0][std::size_t(sector)]; });
    ASSERT_EQ(found, ByDefinition(t_, middle_, star_).meet_well()) << n;
    well += found ? 1 : 0;
  }
  EXPECT_GT(well, kMaps / 50);
  EXPECT_LT(well, kMaps * 3 / 4);
}

TEST_F(RegionStar, CheckDisksAsksItAtCurvesOnly) {
  set_regions([](int sector, bool) { return sector / 4; });
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
