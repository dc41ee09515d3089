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
  double sharpest;  ///< of the tets of the vertex there, but never less than the bound
};

/// Looks for the best place for a vertex whose tets are given by the faces opposite to it. Keeps its buffers.
class PlaceSearch {
 public:
  /// Where a step of this length to this side leads; nothing if it cannot be made. Direction: of unit length.
  using Step = std::function<std::optional<Point>(const Point& from, const Vec& direction, double length_mm)>;
  /// Whether the vertex may be at p; asked only where it would be better.
  using Allow = std::function<bool(const Point& p)>;

  /// bound: the sharpness that is good enough.
  explicit PlaceSearch(double bound) : bound_(bound) {}

  void clear() { faces_.clear(); }
  /// p and q, r, s in the order of the face make a positively oriented tet if p is inside.
  void add_face(const Point& q, const Point& r, const Point& s) { faces_.push_back({q, r, s}); }

  /// A place at least as good as the start. Pre: faces have been added.
  Place run(const Point& start, const Step& step, const Allow& allow);

 private:
  double shortest_edge(const Point& start) const;
  bool look_around(Place& place, double step_mm, const Step& step, const Allow& allow);
  double sharpest_at(const Point& p, double too_sharp);

  double bound_;
  std::vector<Corners> faces_;  // first the one that was too sharp last
  std::size_t direction_ = 0;   // the one that was of use last
};

}  // namespace scantet::optimize
