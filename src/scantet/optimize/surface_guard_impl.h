// Private: keeps the boundary of the mesh on that of the domain while it changes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

#include "scantet/domain/domain.h"
#include "scantet/optimize/element_check_impl.h"

namespace scantet::optimize {

/// The regions on the two sides of a piece of boundary.
struct Sides {
  Region behind = kOutside;
  Region front = kOutside;
};

/// The boundary facets at a vertex v: (v, rim[i], rim[i + 1]) and, last, (v, rim.back(), rim[0]). Their right-hand
/// normals point from the region behind to the one in front.
struct Fan : Sides {
  std::vector<VertexId> rim;
};

/// Boundary facets by their corners. Those that touch no curve come first: nothing is asked of the shape of the others.
class Facets {
 public:
  void clear() {
    all_.clear();
    asked_ = 0;
  }
  void add(const Corners& facet, bool touches_curve) {
    const auto at = touches_curve ? all_.end() : all_.begin() + static_cast<std::ptrdiff_t>(asked_++);
    all_.insert(at, facet);
  }
  void add(const Facets& others) {
    for (std::size_t i = 0; i < others.all_.size(); ++i) add(others.all_[i], i >= others.asked_);
  }
  std::span<Corners> all() { return all_; }
  std::span<const Corners> all() const { return all_; }
  std::span<const Corners> asked() const { return std::span(all_).first(asked_); }

 private:
  std::vector<Corners> all_;
  std::size_t asked_ = 0;
};

/// A boundary facet, whose right-hand normal points from the region behind to the one in front.
struct FacetBetween {
  Corners corners;
  Sides sides;
};

/// The facet that closes a hollow of four facets, and the fourth corner of the tet behind it. The hollow is turned over
/// where its own fourth corner lies on that tet's side: tets overlap, and no two facets of it cross.
struct Lid {
  Corners facet;
  Point behind;
  bool turns_over(const Point& p) const {
    const auto side = [&](const Point& q) { return orientation_mm3(facet[0], facet[1], facet[2], q); };
    return !(side(p) * side(behind) < 0);
  }
};

/// Where a vertex may go.
enum class Freedom {
  inside,      ///< anywhere: no boundary facet at it
  on_surface,  ///< along the surface: its boundary facets are one fan
  none         ///< nowhere, or along its curve: it is on one or at a corner, or the boundary is pinched
};

/// Asks the domain about facets that could be. Keeps its buffers.
class SurfaceGuard {
 public:
  /// tolerance_mm: every facet may be as far from the surface as this. judge: judges facets; null if R1 and R2 are not
  /// asked for.
  SurfaceGuard(const TetComplex& complex, const Domain& domain, double tolerance_mm, const FacetJudge* judge = nullptr)
      : complex_(complex), domain_(domain), tolerance_mm_(tolerance_mm), check_(complex, judge) {}

  /// Says where v may go. Where that is along the surface, `fan` becomes the fan of v.
  Freedom freedom(VertexId v, Fan& fan);
  /// The facets of v's fan, v first.
  Facets facets(VertexId v, const Fan& fan) const;
  /// Whether one of these vertices is on a curve, or at a corner.
  bool touches_curve(std::initializer_list<VertexId> vertices) const {
    return std::any_of(vertices.begin(), vertices.end(), [&](VertexId v) { return complex_.on_curve(v); });
  }
  /// The vertices that boundary facets join to v, ascending, each once.
  std::vector<VertexId> boundary_neighbours(VertexId v);

  /// The facet that closes a hollow of four with the three of a fan that has this rim; none where there is no such
  /// hollow. tips: what the fan's vertex may be; tets with one of them are not behind the lid.
  std::optional<Lid> lid_of(std::span<const VertexId> rim, std::initializer_list<VertexId> tips) const;

  /// The boundary facets at a vertex of a curve that goes straight on there: two edges of the boundary have several
  /// facets, the same number each, and all others two; or all have two, as at sharp edges. Else none.
  std::vector<FacetBetween> facets_on_curve(VertexId v);
  /// Whether a facet may move to where another one is, as facets on curves may, whose shape has no bounds: it turns by
  /// no more than 60° and is no farther from the surface than the tolerance, or than it was. squared_bound: what that
  /// is; found when it is needed first.
  bool may_move(const FacetBetween& facet, const Corners& there, std::optional<double>& squared_bound);

  /// The point nearest to p in which the segment p ± reach crosses the surface from the region behind to the one in
  /// front.
  std::optional<Point> nearest(const Point& p, const Vec& reach, const Sides& sides);

  /// Where a step in the direction, a unit vector, leads: along the plane with the normal, and from there along the
  /// normal onto the surface; nothing if the direction is nearly the normal's or the surface is not near.
  std::optional<Point> step_along(const Point& from, const Vec& direction, double length_mm, const Vec& normal,
                                  const Sides& sides);
  /// The middle of the edge ab, put on the surface along the normal of these facets; nothing if it is not near.
  std::optional<Point> middle_on_surface(VertexId a, VertexId b, const Facets& facets, const Sides& sides);
  /// The unit normal of facets, weighed by their areas.
  static Vec mean_normal(std::span<const Corners> facets);

  /// How sharp the sharpest of the new facets is, if they may take the place of the old ones, whose rim they share:
  /// none turns by more than 60° from the mean of the old ones, none is farther from the surface than the tolerance and
  /// the farthest of the old ones, none that something is asked of breaks a bound by more than the old ones. Else
  /// kInverted. Facets are oriented like those of the fan.
  double rate_replacement(const Facets& old_facets, const Facets& new_facets, const Sides& sides) {
    Known known;
    return rate_replacement(old_facets, new_facets, sides, known, kInverted);
  }
  /// What is known of the facets that are to be replaced: found when it is needed first.
  struct Known {
    std::optional<double> squared_bound{};  ///< how far new facets may be from the surface, squared
    std::optional<double> sharpest{};       ///< what sharpest() says of them
  };
  /// The same for who asks of several replacements of the same facets. Also kInverted if a new facet is as sharp as
  /// `too_sharp`, which is often told without the domain.
  double rate_replacement(const Facets& old_facets, const Facets& new_facets, const Sides& sides, Known& known,
                          double too_sharp);

  /// How sharp the sharpest of these facets is; kNoFacets if nothing is asked of them.
  double sharpest(const Facets& facets);

  /// Whether the surface is near all of these facets: it is not where the domain does not have the mesh's regions.
  bool has_surface_near(const Facets& facets, const Sides& sides) {
    return std::isfinite(squared_bound_of(facets.all(), sides));
  }

  /// Whether two points on the boundary of the domain belong to one component of it.
  bool same_component(const Point& p, const Point& q) const { return domain_.patch_at(p) == domain_.patch_at(q); }

  /// Of the facet's middle and those of its edges, the one farthest from the surface, along the normal. Infinite where
  /// the surface is farther away than half the facet's longest edge.
  double squared_distance_to_surface(const Corners& facet, const Sides& sides);

 private:
  /// An edge across from the vertex, counterclockwise as seen from outside of its tet.
  struct LinkEdge {
    VertexId from;
    VertexId to;
    Region region;  // the region of that tet
  };

  void find_link(VertexId v);
  std::size_t keep_boundary_edges();
  bool turns_little(std::span<const Corners> old_facets, std::span<const Corners> new_facets) const;
  double squared_bound_of(std::span<const Corners> old_facets, const Sides& sides);
  bool is_near(const Corners& facet, const Sides& sides, double squared_bound);

  const TetComplex& complex_;
  const Domain& domain_;
  double tolerance_mm_;
  ElementCheck check_;
  std::vector<LinkEdge> edges_;
  std::vector<Region> front_;
  Crossings crossings_;
};

/// How far boundary facets typically are from the surface: the root mean square of a sample of them, mm.
double typical_distance_mm(const TetComplex& complex, const Domain& domain);

}  // namespace scantet::optimize
