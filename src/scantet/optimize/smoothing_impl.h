// Private: moving one vertex.
#pragma once

#include <vector>

#include "scantet/optimize/curve_guide_impl.h"
#include "scantet/optimize/place_search_impl.h"

namespace scantet::optimize {

/// Looks for better places for vertices; keeps its buffers.
class Smoothing {
 public:
  /// curves: of the domain; null: vertices of curves stay.
  Smoothing(const TetComplex& complex, SurfaceGuard& guard, Depth depth = Depth::usual,
            const CurveGuide* curves = nullptr)
      : complex_(complex), guard_(guard), curves_(curves), search_(complex.judge(), depth) {}

  /// Puts into `best` a place for v where no tet around it is as sharp as best.sharpest, if one is found. A vertex of
  /// the boundary stays on its component of the surface, one of a curve on its curve.
  void try_vertex(VertexId v, Change& best);

 private:
  Place find_inside(const Point& start);
  Place find_on_surface(VertexId v);
  std::optional<Place> find_on_curve(VertexId v, const Curve& curve);
  const Curve* curve_of(VertexId v) const;

  const TetComplex& complex_;
  SurfaceGuard& guard_;
  const CurveGuide* curves_;
  PlaceSearch search_;
  Fan fan_;
  Facets moved_facets_;
};

}  // namespace scantet::optimize
