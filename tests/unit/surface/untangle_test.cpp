// Tets of a good mesh change sides; untangling has to bring them back.
#include <set>

#include "scantet/domain/analytic.h"
#include "scantet/surface/untangle_impl.h"
#include "unit/surface/samples.h"

namespace scantet::engine {
namespace {

class Untangling : public testing::Test {
 protected:
  Untangling() : restricted_(triangulated(*torus_, sparse_sample(*torus_, 0.7, 1))), t_(restricted_.triangulation()) {
    Progress silent;
    check_all_disks(t_, restricted_.disks(), [&] { return boundary_facets(t_); });
  }
  std::vector<Region> regions() const {
    std::vector<Region> all;
    for (CellId c = 0; c < t_.cell_slots(); ++c) all.push_back(t_.info(c).region);
    return all;
  }
  /// Moves tets to the other side that have only neighbours on their own side, none of them near another one, and none
  /// near the hole, where the tets outside are small as well. Returns how many.
  std::size_t turn_some(Region from) {
    std::set<PointId> near;
    for (CellId c = 0; c < t_.cell_slots(); ++c) {
      if (!t_.is_cell(c) || t_.has_corner(c) || t_.info(c).region != from) continue;
      const auto& vertices = t_.cell(c).vertex;
      const bool is_amid = std::all_of(vertices.begin(), vertices.end(), [&](PointId v) {
        const FacetCode across = t_.cell(c).neighbor[static_cast<std::size_t>(t_.index_of(c, v))];
        const bool is_outer = from == kOutside || std::hypot(t_.point(v).x, t_.point(v).y) > 5;
        return is_outer && near.count(v) == 0 && across != kNone && t_.info(across / 4).region == from;
      });
      if (!is_amid) continue;
      for (const PointId v : vertices) {
        t_.star_of(v, star_);
        for (const CellId around : star_) near.insert(t_.cell(around).vertex.begin(), t_.cell(around).vertex.end());
      }
      for (PointId corner = 0; corner < Triangulation::kCorners; ++corner) near.erase(corner);
      restricted_.change_side(c, 1 - from);
      turned_.push_back(c);
    }
    return turned_.size();
  }

  std::unique_ptr<Domain> torus_ = make_torus({}, 5, 2);
  RestrictedTriangulation restricted_;
  Triangulation& t_;
  std::vector<CellId> star_;
  std::vector<CellId> turned_;
};

TEST_F(Untangling, LeavesAGoodSurfaceAlone) {
  const std::vector<Region> before = regions();
  const UniformSize size(2);
  KnownBoundary boundary(restricted_);
  Untangler untangler(*torus_, restricted_, boundary, size, 1);
  EXPECT_EQ(untangler.run(), 0U);
  EXPECT_EQ(regions(), before);
  EXPECT_TRUE(untangler.tangles().pieces.empty());
  EXPECT_TRUE(untangler.tangles().vertices.empty());
}

TEST_F(Untangling, BringsSmallGroupsBackToTheSideAroundThem) {
  const std::vector<Region> good = regions();
  const std::size_t turned = turn_some(kOutside);
  ASSERT_GE(turned, 2U);
  const UniformSize size(4);
  KnownBoundary boundary(restricted_);
  Untangler untangler(*torus_, restricted_, boundary, size, 1);
  EXPECT_EQ(untangler.tangles().vertices.size(), 4 * turned) << "each of their vertices is a pinch";
  EXPECT_EQ(untangler.run(), turned);
  EXPECT_EQ(regions(), good);
  EXPECT_TRUE(untangler.tangles().vertices.empty());
  EXPECT_EQ(untangler.run(), turned) << "nothing is left to do; what has changed is still counted";
  EXPECT_EQ(regions(), good);
}

TEST_F(Untangling, FillsSmallCavities) {
  const std::size_t turned = turn_some(1);
  ASSERT_GE(turned, 10U);
  const UniformSize size(4);
  KnownBoundary boundary(restricted_);
  Untangler untangler(*torus_, restricted_, boundary, size, 1);
  EXPECT_EQ(untangler.tangles().vertices.size(), 4 * turned);
  EXPECT_LT(untangler.run(), turned * 3 / 2) << "besides them, smaller tets that they part from the inside";
  EXPECT_TRUE(untangler.tangles().vertices.empty());
}

TEST_F(Untangling, LeavesGroupsLargerThanTheSize) {
  ASSERT_GE(turn_some(1), 2U);
  const std::vector<Region> tangled = regions();
  const UniformSize size(0.05);
  KnownBoundary boundary(restricted_);
  Untangler untangler(*torus_, restricted_, boundary, size, 1);
  EXPECT_EQ(untangler.run(), 0U);
  EXPECT_EQ(regions(), tangled);
  EXPECT_FALSE(untangler.tangles().vertices.empty());
}

/// As it is where points have been inserted beside tets that had changed sides.
TEST_F(Untangling, CoversVerticesOffTheBoundary) {
  ASSERT_GE(turn_some(kOutside), 2U);
  std::vector<PointId> exposed;
  for (const CellId c : turned_) {
    for (const PointId v : t_.cell(c).vertex) {
      t_.star_of(v, star_);
      if (std::any_of(star_.begin(), star_.end(), [&](CellId at) { return t_.has_corner(at); })) continue;
      exposed.push_back(v);
      break;
    }
  }
  ASSERT_FALSE(exposed.empty());
  for (const PointId v : exposed) t_.vertex_info(v).dimension = 3;
  const UniformSize size(0.01);  // nothing is small enough to change for its own sake
  KnownBoundary boundary(restricted_);
  Untangler untangler(*torus_, restricted_, boundary, size, 1);
  untangler.run();
  for (const FacetCode facet : boundary_facets(t_)) {
    for (const PointId v : facet_vertices(t_.cell(facet / 4), static_cast<int>(facet % 4))) {
      EXPECT_TRUE(t_.vertex_info(v).on_boundary()) << v;
    }
  }
}

TEST_F(Untangling, TellsThePiecesThatAreLeft) {
  const auto sparse = sparse_sample(*torus_, 0.9, 30);
  RestrictedTriangulation torn = triangulated(*torus_, sparse);
  const UniformSize size(0.01);  // nothing is small enough to change
  KnownBoundary boundary(torn);
  Untangler untangler(*torus_, torn, boundary, size, 1);
  const Tangles tangles = untangler.tangles();
  Pieces pieces(torn, BoundarySurfaces(torn, BoundaryFacets(torn, boundary_facets(torn.triangulation()))));
  std::set<std::uint32_t> expected;
  for (const FacetCode side : pieces.side_facets()) expected.insert(pieces.of(side / 4));
  EXPECT_EQ(tangles.pieces.size(), expected.size());
  EXPECT_FALSE(tangles.vertices.empty() && tangles.pieces.empty());
}

}  // namespace
}  // namespace scantet::engine
