#include <algorithm>
#include <set>

#include "scantet/domain/analytic.h"
#include "scantet/surface/boundary_link_impl.h"
#include "unit/surface/ring_star.h"
#include "unit/surface/samples.h"

namespace scantet::engine {
namespace {

class BoundaryLink : public RingStar {
 protected:
  BoundaryLink() { notes_.grow(t_.vertex_slots()); }

  /// Whether check_disks() finds a disk around the middle, from its star or from all facets.
  bool has_disk(const std::function<Region(int, bool)>& region_of, bool from_star) {
    set_regions(region_of);
    if (from_star) add_known_vertices();
    notes_.grow(t_.vertex_slots());
    for (PointId v = 0; v < t_.vertex_slots(); ++v) notes_.set_disk(v, v != middle_);
    const std::vector<PointId> broken = check_all_disks(t_, notes_, [&] {
      EXPECT_FALSE(from_star);
      return boundary_facets(t_);
    });
    EXPECT_EQ(broken.empty(), notes_.has_disk(middle_));
    return broken.empty();
  }

  DiskNotes notes_;

 private:
  /// Slots, so that the middle is one of few that are in question.
  void add_known_vertices() {
    while (t_.vertex_slots() < 100) t_.add_vertex();
  }
};

TEST_F(BoundaryLink, OneClosedPathIsADisk) {
  for (const bool from_star : {false, true}) {
    EXPECT_TRUE(has_disk([](int, bool above) { return above ? 1 : 0; }, from_star));
    EXPECT_TRUE(has_disk([](int sector, bool) { return sector < 5 ? 1 : 0; }, from_star));
    EXPECT_TRUE(has_disk([](int sector, bool above) { return sector == 3 && above ? 1 : 0; }, from_star));
    EXPECT_TRUE(has_disk([](int sector, bool above) { return sector == 3 && above ? 1 : 2; }, from_star));
  }
}

TEST_F(BoundaryLink, AnythingElseIsNone) {
  for (const bool from_star : {false, true}) {
    const auto cones = [](int sector, bool above) { return (sector == 0 && above) || (sector == 6 && !above) ? 1 : 0; };
    EXPECT_FALSE(has_disk(cones, from_star)) << "two closed paths";
    EXPECT_FALSE(has_disk([](int sector, bool) { return sector / 3 % 2; }, from_star)) << "a path that meets itself";
    EXPECT_FALSE(has_disk([](int sector, bool) { return sector / 4; }, from_star)) << "three half planes";
    EXPECT_FALSE(has_disk([](int, bool) { return 1; }, from_star)) << "no facets";
  }
}

TEST_F(BoundaryLink, AVertexInsideIsNotAsked) {
  t_.vertex_info(middle_).dimension = 3;
  EXPECT_TRUE(check_all_disks(t_, notes_, [&] { return boundary_facets(t_); }).size() < t_.vertex_count());
  EXPECT_FALSE(notes_.has_disk(middle_));
}

TEST(CheckDisks, StarsAndFacetsTellTheSame) {
  const auto torus = make_torus({}, 5, 0.7);
  RestrictedTriangulation all = triangulated(*torus, sparse_sample(*torus, 0.6, 5));
  Triangulation& t = all.triangulation();
  std::size_t asked = 0;
  const auto facets = [&] {
    ++asked;
    return boundary_facets(t);
  };
  const std::vector<PointId> broken = check_all_disks(t, all.disks(), facets);
  EXPECT_EQ(asked, 1U);
  ASSERT_FALSE(broken.empty());
  ASSERT_LT(broken.size(), t.vertex_count());
  constexpr PointId kFew = 40;  // one in so many, for which stars are looked at
  for (PointId first = 0; first < kFew; ++first) {
    std::vector<PointId> expected;
    for (PointId v = Triangulation::kCorners; v < t.vertex_slots(); ++v) {
      const bool is_broken = std::binary_search(broken.begin(), broken.end(), v);
      all.disks().set_disk(v, v % kFew != first);
      if (v % kFew == first && is_broken) expected.push_back(v);
    }
    EXPECT_EQ(check_all_disks(t, all.disks(), facets), expected);
  }
  EXPECT_EQ(asked, 1U);
}

TEST(BrokenDisks, TellsThoseOnFacetsFromThoseThatHaveNone) {
  const auto torus = make_torus({}, 5, 0.7);
  RestrictedTriangulation all = triangulated(*torus, sparse_sample(*torus, 0.6, 5));
  Triangulation& t = all.triangulation();
  BrokenDisks disks(all);
  BoundaryFacets all_facets;
  const auto facets = [&]() -> const BoundaryFacets& { return all_facets = with_corners(t, boundary_facets(t)); };
  disks.update(facets);
  ASSERT_FALSE(disks.all().empty());
  const PointId buried = disks.all().front();
  std::vector<CellId> star;
  t.star_of(buried, star);
  for (const CellId c : star) {
    t.info(c).region = kOutside;
    for (const PointId v : t.cell(c).vertex) {
      if (v < Triangulation::kCorners) continue;
      all.question(v);
    }
  }
  disks.update(facets);
  std::set<PointId> expected;
  for (const FacetCode facet : facets().codes) {
    for (const PointId v : facet_vertices(t.cell(facet / 4), static_cast<int>(facet % 4))) {
      if (!all.disks().has_disk(v)) expected.insert(v);
    }
  }
  EXPECT_TRUE(std::binary_search(disks.all().begin(), disks.all().end(), buried));
  EXPECT_EQ(expected.count(buried), 0U);
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(disks.on_facets(), std::vector<PointId>(expected.begin(), expected.end()));
}

}  // namespace
}  // namespace scantet::engine
