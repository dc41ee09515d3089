// Private: where the restricted triangulation has not the topology of the domain, and the points that mend it.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <vector>

#include "scantet/domain/known_components.h"
#include "scantet/surface/extra_point_impl.h"
#include "scantet/surface/untangle_impl.h"

namespace scantet::engine {

/// Looks for signs that the boundary sample is too sparse, each of which a sample that satisfies I1 cannot show (paper,
/// Theorems 1 and 2, Lemma 3), and returns the boundary points that answer them:
/// - the boundary facets around a vertex do not form one disk: the centre of the largest surface ball around it;
/// - a component or cavity that the domain lists, or knows beside others, has no restricted facet: points on it;
/// - a component of a domain that lists all of them is in several pieces: on the smaller pieces, the centres of surface
/// balls that are large
///   beside the local thickness, which is where a neck was missed.
class TopologyRepair {
 public:
  /// Balls much smaller than alpha times the size there are left as they are.
  /// boundary: of this triangulation.
  TopologyRepair(const Domain& domain, RestrictedTriangulation& triangulation, KnownBoundary& boundary,
                 const SizingField& size, double alpha)
      : domain_(domain),
        triangulation_(triangulation),
        boundary_(boundary),
        size_(size),
        alpha_(alpha),
        known_(known_components(domain)) {}

  /// The points that answer the first sign. Costs what has changed since the call before.
  std::vector<ExtraPoint> points_at_pinches();

  /// The points that answer the others, which are seen better when no pinch is left. Looks at all of the boundary.
  /// Pre: points_at_pinches() has been called since a point was inserted.
  std::vector<ExtraPoint> points_on_pieces();

  /// The points that answer the tangles that untangling leaves: around channels (ChannelSearch), and the centres of
  /// balls at pinches, also of smaller ones.
  std::vector<ExtraPoint> points_at(const Tangles& tangles);

  /// A place for each of these tangles, and for each component or cavity without a facet.
  std::vector<Point> places_of(const Tangles& tangles);

  /// Where the domain, or what is outside, is a sheet thinner than the smallest balls, so that points only made more
  /// pinches: none are inserted in sheets since then. Empty if no such sheet was met.
  const std::vector<Point>& sheets() const { return sheets_; }

  /// Whether points_on_pieces() has found a disk around every vertex of the boundary, and one surface for each of its
  /// components, and no call since has looked for pinches.
  bool is_whole() const { return is_whole_; }

 private:
  /// The largest ball around a vertex without a disk.
  struct Pinch {
    PointId vertex;
    std::uint32_t ball;
  };
  /// The facets of a piece, each by its vertices.
  using Outline = std::vector<std::array<PointId, 3>>;
  void find_channels(const Tangles& tangles);
  Outline outline_of(const std::vector<FacetCode>& facets) const;
  const Point& vertex_of(FacetCode facet) const;
  bool is_large(const SurfaceBall& ball, double share) const;
  std::vector<ExtraPoint> take_points(double empty_share);
  void find_walls();
  void check_components(const BoundarySurfaces& surfaces, std::size_t points_each);
  void check_pieces(const BoundarySurfaces& surfaces);
  void find_thin_balls(FacetCode facet, Crossings& crossings, std::vector<std::uint32_t>& found) const;
  void look_for_sheets();
  bool is_narrower_than(double smallest_radii, const SurfaceBall& ball, Crossings& crossings) const;
  bool is_larger_than_thickness(const SurfaceBall& ball, FacetCode inside, Crossings& crossings) const;

  const Domain& domain_;
  RestrictedTriangulation& triangulation_;
  KnownBoundary& boundary_;
  const SizingField& size_;
  double alpha_;
  /// A point of ∂O seen from within a component or cavity.
  struct Wall {
    Patch patch;
    Point point;
  };
  ComponentList known_;
  std::vector<std::vector<Wall>> walls_;     // of each component, found when they are needed first
  std::optional<std::vector<Point>> hints_;  // the places of the domain's, found when they are needed first
  std::set<Outline> closed_;                 // pieces that no channel was found from
  bool is_whole_ = false;
  std::size_t last_pinches_ = 0;      // as of the last look
  std::size_t first_pinches_ = 0;     // as of the look since which there have been more each time
  int growing_rounds_ = 0;            // since then, and with it
  std::vector<Point> sheets_;         // see sheets()
  std::vector<Pinch> pinches_;        // with balls that are not too small to be mended, as of the last look
  std::vector<std::uint32_t> balls_;  // their centres are missing
  std::vector<Point> points_;         // these are missing, too
};

}  // namespace scantet::engine
