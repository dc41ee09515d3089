// Private: a new vertex on an edge of the boundary, moved along the surface to where it is of most use.
#pragma once

#include "scantet/optimize/edge_split_impl.h"

namespace scantet::optimize {

/// Looks for edges between two boundary facets to split; keeps its buffers.
class BoundarySplit {
 public:
  /// first_new: vertices from this on are of earlier splits.
  BoundarySplit(const TetComplex& complex, SurfaceGuard& guard, VertexId first_new, Depth depth = Depth::usual)
      : complex_(complex), guard_(guard), first_new_(first_new), search_(complex.judge(), depth) {}

  /// Puts into `best` a new vertex on the surface that divides the tets and the two facets at the edge ab, if then none
  /// of them is as sharp as best.sharpest or, where one of the tets has a new vertex already, as the bound: else there
  /// would be no end to it. Inner edges, and those of curves, are passed over.
  void try_edge(VertexId a, VertexId b, Change& best);

 private:
  bool find_facets(VertexId a, VertexId b);

  const TetComplex& complex_;
  SurfaceGuard& guard_;
  VertexId first_new_;
  PlaceSearch search_;
  Fan fan_;
  Facets facets_;   // the two at the edge
  Facets divided_;  // the four of the new vertex, which is their first corner
  DividedTets tets_;
};

}  // namespace scantet::optimize
