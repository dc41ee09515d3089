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
  /// How sharp the sharpest of the vertex's tets and boundary facets is there; the bound if that is less.
  double sharpest;
};

/// How small the steps of a search get, and how little a gain may be. A deep search takes several times as long as the
/// usual one, and finds places that the usual one just misses.
enum class Depth { usual, deep };

/// Boundary facets of a vertex that is looked for a place, their first corner, and those whose rim they have.
struct SurfaceMove {
  const Facets& before;
  Facets& moved;
  const Sides& sides;
  std::optional<Lid> lid{};          ///< of the hollow that the facets have part in
  std::optional<double> sharpest{};  ///< of the facets before, if the vertex starts from where it is
};

/// Looks for the best place for a vertex whose tets are given by the faces opposite to it. Keeps its buffers.
class PlaceSearch {
 public:
  /// Where a step of this length in this direction, a unit vector, leads; nothing if the step cannot be made.
  using Step = std::function<std::optional<Point>(const Point& from, const Vec& direction, double length_mm)>;
  /// How sharp the boundary facets of the vertex would be if it were at p (facets that break a bound count as tets do);
  /// kInverted if it may not be there, or if one is as sharp as `too_sharp`. Asked only where the tets would be better.
  using RateFacets = std::function<double(const Point& p, double too_sharp)>;

  /// judge: judges the tets; must outlive the search.
  explicit PlaceSearch(const TetJudge& judge, Depth depth = Depth::usual)
      : judge_(judge), bound_(judge.bound()), depth_(depth) {}

  void clear() { faces_.clear(); }
  /// Adds the face (q, r, s) of a tet of the vertex. With the vertex p in front, (p, q, r, s) must be positively
  /// oriented if p is inside.
  void add_face(const Point& q, const Point& r, const Point& s) { faces_.push_back({q, r, s}); }

  /// Adds the faces opposite to v of its tets, but for those with another vertex.
  void add_star(const TetComplex& complex, VertexId v, VertexId without = kNoVertex);

  /// Returns a place at least as good as the start. facets_at_start: how sharp the vertex's boundary facets are at the
  /// start. Pre: faces have been added.
  Place run(const Point& start, double facets_at_start, const Step& step, const RateFacets& rate_facets);

  /// The same along the surface, for a vertex of the boundary.
  Place run_on_surface(const Point& start, SurfaceGuard& guard, const SurfaceMove& move);

 private:
  double shortest_edge(const Point& start) const;
  bool look_around(Place& place, double step_mm, const Step& step, const RateFacets& rate_facets);
  double sharpest_at(const Point& p, double too_sharp);

  const TetJudge& judge_;
  double bound_;
  Depth depth_;
  std::vector<Corners> faces_;  // first the face whose tet was too sharp last
  std::size_t direction_ = 0;   // the direction that was of use last
};

}  // namespace scantet::optimize
