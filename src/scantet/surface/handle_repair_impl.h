// Private: where the restricted triangulation has lost or made handles, and the points that mend it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scantet/base/large_pages.h"
#include "scantet/domain/domain.h"
#include "scantet/domain/sizing_field.h"
#include "scantet/surface/extra_point_impl.h"
#include "scantet/surface/known_boundary_impl.h"
#include "scantet/surface/restricted_triangulation_impl.h"
#include "scantet/surface/watched_ways_impl.h"

namespace scantet::engine {

/// A thread that the sample does not show, or a slit that facets bridge, leaves a boundary whose every vertex has a
/// disk and whose components are all there, with a handle less or more. The domain knows where to look: ways along its
/// narrow parts (Domain::narrow_ways), which must be in tets of their regions, and places on the wrong side of the mesh
/// that seem to change its topology (Domain::misplaced). And where the boundary has a handle too many, the handle
/// itself tells: across it the domain is on the other side (false_handles()). Where a tet there is of another region,
/// the facet with the largest ball of the tet's parts it from where it belongs; the ball's centre is inserted. A way
/// has some width, and facets with balls smaller than that do not cross it, so this ends.
class HandleRepair {
 public:
  /// How far the search for handles goes.
  struct Care {
    /// Tets on broken ways for each boundary vertex; of more, and more than 1,000, none is mended.
    double most_broken = 0;
    /// Whether handles are mended then, too, if no more than 20 are wrong.
    bool keeps_few = false;
    int way_rounds = 0;  ///< how often ways get points at the most
    LevelGround ground = LevelGround::ends_ways;
    std::span<const NarrowWay> asked{};  ///< kept beside the domain's own
  };

  /// boundary: of this triangulation.
  HandleRepair(const Domain& domain, RestrictedTriangulation& triangulation, KnownBoundary& boundary,
               const SizingField& size, double alpha, const Care& care);

  /// The points that are missing now: those that ways ask for as long as any does, then those that misplaced places ask
  /// for. Of a domain that does not know its components those of ways alone. Empty if the boundary has the Euler number
  /// of the domain, or that of known components is not known; when neither is left; after as many calls as way_rounds
  /// and the constant below say; or if so many ways are broken that the size is too coarse for the handles.
  std::vector<ExtraPoint> missing_points();

  /// Those that ways ask for, if missing_points() found another Euler number when it was last called, or the domain
  /// does not know its components. Costs what has changed since the ways were followed last, and does not count the
  /// boundary's Euler number anew.
  std::vector<ExtraPoint> points_on_ways();

  /// Those that the ways ask for that were asked for.
  std::vector<ExtraPoint> points_on_asked_ways();
  bool are_ways_asked_for() const { return !care_.asked.empty(); }

  /// The last resort, if missing_points() found another Euler number when it was last called and asks for nothing:
  /// where a dual edge meets one patch more than once its facet stands for one piece of it at the most, and the centre
  /// of the largest ball is asked for. Empty if there are over a thousand, and once a call leaves more than three
  /// quarters of them.
  std::vector<ExtraPoint> points_on_chains();

  /// Those that handles of the boundary ask for that the domain has not, if there must be such handles. Empty after
  /// four calls.
  std::vector<ExtraPoint> points_on_false_handles();
  bool has_other_euler_number() const { return is_other_euler_number_ && !are_too_many_; }

  /// Where the boundary seems to have a handle more or less than the domain though the Euler numbers are the same, so
  /// that one has been made for one lost: a point for each group of misplaced places. None if the domain has no handle.
  std::vector<Point> exchanged_places();

  /// Where the boundary seems to have a handle more or less than the domain, if its Euler number is another: a point
  /// for each group of misplaced places, or of tets if there are none, or else where ways are broken. None where the
  /// handles are too many.
  std::vector<Point> wrong_places();
  /// By how much the boundary's Euler number would have to grow to be the domain's. 0 if that is not known, or where
  /// the handles are too many.
  std::int64_t missing_euler();
  /// By how many handles the boundary's Euler number is another than the domain's. 0 if that is not known, or where the
  /// handles are too many.
  std::uint64_t wrong_count();

  /// Whether so many ways are broken that no points are asked for: the size is too coarse for the handles.
  bool are_too_many() const { return are_too_many_; }
  /// More rounds of points on ways, and as many at nodes, as the untangled boundary has lost or made other handles.
  /// rounds: 0 to 4. seeks_exchanged: whether there must be handles that the domain has not, for others that are lost.
  void begin_again(int rounds, bool seeks_exchanged) {
    seeks_exchanged_ = seeks_exchanged;
    way_rounds_ = std::min(way_rounds_, std::max(0, care_.way_rounds - rounds));
    place_rounds_ = std::min(place_rounds_, kPlaceRounds - rounds);
  }
  /// Takes it that they are, as a mesh before this one has found.
  void leave_out() { are_too_many_ = true; }

 private:
  static constexpr double kClosest = 1e-3;  // of alpha·σ
  static constexpr int kPlaceRounds = 4;
  static constexpr int kFalseRounds = 4;

  bool are_far_too_many(double most);
  TriangleSurface boundary_within(Region first);
  std::vector<WrongTet> misplaced();
  std::vector<WrongTet> wrong_at(const std::vector<Misplaced>& places, std::size_t places_each) const;
  std::vector<Point> one_of_each_group();
  std::vector<CellId> cells_at(const std::vector<Misplaced>& places) const;
  bool has_euler_number();
  std::vector<ExtraPoint> points_at(const std::vector<WrongTet>& wrong);
  /// A point there is not put closer to others, mm.
  double closest_at(const Point& p) const { return kClosest * alpha_ * size_.size_at(p); }
  std::vector<ExtraPoint> leave_ways();
  bool meets_a_patch_again(const SurfaceBall& first) const;
  void add_points_at(const WrongTet& wrong);
  std::uint32_t largest_ball(CellId cell) const;
  void add_points_around(const WrongTet& wrong);

  const Domain& domain_;
  RestrictedTriangulation& restricted_;
  Triangulation& t_;
  KnownBoundary& boundary_;
  const SizingField& size_;
  double alpha_;
  Care care_;
  WatchedWays watched_asked_;
  LargeVector<NarrowWay> ways_;  // found when they are needed first
  WatchedWays watched_;
  bool knows_ways_ = false;
  /// The boundary's, as missing_points() has found.
  bool is_other_euler_number_ = false;
  /// What components the domain has, as of one that planes cut: its ways are kept all the same.
  bool is_unknown_ = false;
  Region last_region_ = 1;                      // of the domain
  std::optional<std::int64_t> euler_;           // of all components' boundaries; none if not known
  std::optional<std::int64_t> domain_handles_;  // of all its components; none if not known
  bool are_too_many_ = false;
  int way_rounds_ = 0;
  int place_rounds_ = 0;
  int false_rounds_ = 0;
  bool seeks_exchanged_ = false;
  std::size_t most_chains_ = static_cast<std::size_t>(-1);  // facets whose dual edges may meet the boundary again
  std::vector<ExtraPoint> points_;
};

}  // namespace scantet::engine
