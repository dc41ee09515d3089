// Private: where to put a vertex.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "scantet/optimize/change_impl.h"
#include "scantet/optimize/surface_guard_impl.h"

namespace scantet::optimize {

/// A place for a vertex, and how good it is.
struct Place {
  Point point;
  double sharpest;  ///< of the tets and boundary facets of the vertex there, but never less than the bound
};

/// How small the steps get, and how little a gain may be. Deep takes several times as long and finds what usual just
/// misses.
enum class Depth { usual, deep };

/// Looks for the best place for a vertex whose tets are given by the faces opposite to it. Keeps its buffers.
class PlaceSearch {
 public:
  /// Where a step of this length to this side leads; nothing if it cannot be made. Direction: of unit length.
  using Step = std::function<std::optional<Point>(const Point& from, const Vec& direction, double length_mm)>;
  /// How sharp the boundary facets of the vertex would be if it were at p (facets that break a bound count as tets do);
  /// kInverted if it may not be there. Asked only where the tets would be better.
  using RateFacets = std::function<double(const Point& p)>;

  /// judge: of tets; outlives the search.
  explicit PlaceSearch(const TetJudge& judge, Depth depth = Depth::usual)
      : judge_(judge), bound_(judge.bound()), depth_(depth) {}

  void clear() { faces_.clear(); }
  /// p and q, r, s in the order of the face make a positively oriented tet if p is inside.
  void add_face(const Point& q, const Point& r, const Point& s) { faces_.push_back({q, r, s}); }

  /// A place at least as good as the start, whose facets are as sharp as facets_at_start. Pre: faces have been added.
  Place run(const Point& start, double facets_at_start, const Step& step, const RateFacets& rate_facets);

 private:
  double shortest_edge(const Point& start) const;
  bool look_around(Place& place, double step_mm, const Step& step, const RateFacets& rate_facets);
  double sharpest_at(const Point& p, double too_sharp);

  const TetJudge& judge_;
  double bound_;
  Depth depth_;
  std::vector<Corners> faces_;  // first the one that was too sharp last
  std::size_t direction_ = 0;   // the one that was of use last
};

}  // namespace scantet::optimize
