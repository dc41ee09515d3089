// A ring is cut through, dented and holed by tets that change sides.
#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "scantet/domain/analytic.h"
#include "scantet/surface/misplaced_groups_impl.h"
#include "scantet/surface/untangle_impl.h"
#include "unit/surface/samples.h"

namespace scantet::engine {
namespace {

constexpr double kRingRadius = 5;
constexpr double kTubeRadius = 2;

class MisplacedGroups : public testing::Test {
 protected:
  MisplacedGroups()
      : restricted_(triangulated(*torus_, sparse_sample(*torus_, 0.7, 1))), t_(restricted_.triangulation()) {
    Progress silent;
    check_all_disks(t_, restricted_.disks(), [&] { return boundary_facets(t_); });
  }
  Point centroid(CellId c) const {
    const auto p = t_.points_of(c);
    return p[0] + 0.25 * ((p[1] - p[0]) + (p[2] - p[0]) + (p[3] - p[0]));
  }
  /// Turns the tets of a region whose centroids are at such places.
  std::size_t turn(Region from, const std::function<bool(const Point&)>& is_there) {
    std::size_t count = 0;
    for (CellId c = 0; c < t_.cell_slots(); ++c) {
      if (!t_.is_cell(c) || t_.has_corner(c) || t_.info(c).region != from) continue;
      if (!is_there(centroid(c))) continue;
      restricted_.change_side(c, 1 - from);
      ++count;
    }
    return count;
  }
  /// Where the ring crosses the x axis.
  static bool is_on_cut(const Point& p) { return p.x > 0 && std::abs(p.y) < 0.8; }
  /// Of the tets inside with all that they have.
  int euler_number() const {
    std::set<std::vector<PointId>> simplices;
    for (CellId c = 0; c < t_.cell_slots(); ++c) {
      if (!t_.is_cell(c) || t_.info(c).region == kOutside) continue;
      for (unsigned some = 1; some < 16; ++some) {
        std::vector<PointId> simplex;
        for (std::size_t i = 0; i < 4; ++i) {
          if (some >> i & 1) simplex.push_back(t_.cell(c).vertex[i]);
        }
        std::sort(simplex.begin(), simplex.end());
        simplices.insert(simplex);
      }
    }
    int euler = 0;
    for (const auto& simplex : simplices) euler += simplex.size() % 2 == 1 ? 1 : -1;
    return euler;
  }
  /// Sends groups where they belong, one after another.
  void check_changes(const std::vector<MisplacedGroup>& groups) {
    for (const MisplacedGroup& group : groups) {
      const int before = euler_number();
      for (const CellId c : group.cells) restricted_.change_side(c, group.to);
      EXPECT_EQ(euler_number() - before, group.euler_change);
      EXPECT_EQ(torus_->region_at(group.place), group.to);
    }
  }

  std::unique_ptr<Domain> torus_ = make_torus({}, kRingRadius, kTubeRadius);
  RestrictedTriangulation restricted_;
  Triangulation& t_;
};

TEST_F(MisplacedGroups, AGoodSurfaceHasNone) {
  EXPECT_TRUE(misplaced_groups(*torus_, t_).empty());
}

TEST_F(MisplacedGroups, ADentDoesNotCount) {
  ASSERT_GT(turn(1, [](const Point& p) { return is_on_cut(p) && p.z > 1.2; }), 0U);
  EXPECT_TRUE(misplaced_groups(*torus_, t_).empty());
}

TEST_F(MisplacedGroups, ACutThroughTheRingCounts) {
  ASSERT_GT(turn(1, is_on_cut), 0U);
  ASSERT_EQ(euler_number(), 1) << "a ball";
  const std::vector<MisplacedGroup> groups = misplaced_groups(*torus_, t_);
  ASSERT_FALSE(groups.empty());
  check_changes(groups);
  EXPECT_EQ(euler_number(), 0) << "a ring again";
}

TEST_F(MisplacedGroups, AMembraneAcrossTheHoleCounts) {
  ASSERT_GT(turn(kOutside, [](const Point& p) { return std::hypot(p.x, p.y) < kRingRadius - 1 && std::abs(p.z) < 1; }),
            0U);
  ASSERT_NE(euler_number(), 0);
  const std::vector<MisplacedGroup> groups = misplaced_groups(*torus_, t_);
  ASSERT_FALSE(groups.empty());
  check_changes(groups);
  EXPECT_EQ(euler_number(), 0);
}

TEST_F(MisplacedGroups, UntanglingTurnsThemOver) {
  turn(1, is_on_cut);
  const UniformSize size(20);  // to which the group is small
  KnownBoundary boundary(restricted_);
  Untangler untangler(*torus_, restricted_, boundary, size, 1);
  EXPECT_FALSE(untangler.turn_over(misplaced_groups(*torus_, t_), 1)) << "it would lead away";
  EXPECT_EQ(euler_number(), 1);
  EXPECT_TRUE(untangler.turn_over(misplaced_groups(*torus_, t_), -1));
  EXPECT_EQ(euler_number(), 0);
}

TEST_F(MisplacedGroups, UntanglingLeavesLargeOnes) {
  turn(1, is_on_cut);
  const UniformSize size(0.5);
  KnownBoundary boundary(restricted_);
  Untangler untangler(*torus_, restricted_, boundary, size, 1);
  EXPECT_FALSE(untangler.turn_over(misplaced_groups(*torus_, t_), -1));
}

}  // namespace
}  // namespace scantet::engine
