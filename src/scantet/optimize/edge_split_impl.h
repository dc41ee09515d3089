// Private: a new vertex on an edge, moved to where it is of most use.
#pragma once

#include "scantet/optimize/place_search_impl.h"

namespace scantet::optimize {

/// The tets at an edge, and what becomes of them at a new vertex on it: two of each, one with each end.
struct DividedTets {
  std::vector<TetId> removed;
  std::vector<NewTet> added;

  /// Lists those at the edge ab, and adds to the search the faces that the new vertex will see.
  void divide(const TetComplex& complex, VertexId a, VertexId b, PlaceSearch& search);
  /// Whether one of the tets has a vertex from `first` on.
  bool have_vertex_from(const TetComplex& complex, VertexId first) const;
  /// Makes the change one that puts the vertex there. What it was found from is left to the caller.
  void put_into(Change& change, const Place& place, bool on_boundary) const;
};

/// Looks for inner edges to split; keeps its buffers.
class EdgeSplit {
 public:
  /// first_new: vertices from this on are of earlier splits.
  EdgeSplit(const TetComplex& complex, VertexId first_new, Depth depth = Depth::usual)
      : complex_(complex), first_new_(first_new), bound_(complex.judge().bound()), search_(complex.judge(), depth) {}

  /// Puts into `best` a new vertex that divides the tets at the edge ab, if then none of them is as sharp as
  /// best.sharpest or, where one has a new vertex already, as the bound: else there would be no end to it. Boundary
  /// edges are passed over.
  void try_edge(VertexId a, VertexId b, Change& best);

 private:
  bool divide(VertexId a, VertexId b);

  const TetComplex& complex_;
  VertexId first_new_;
  double bound_;
  PlaceSearch search_;
  DividedTets tets_;
  std::vector<VertexId> from_;
  std::vector<VertexId> to_;
};

}  // namespace scantet::optimize
