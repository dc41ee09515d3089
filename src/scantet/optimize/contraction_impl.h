// Private: taking an edge away, and one of its vertices with it.
#pragma once

#include <optional>
#include <vector>

#include "scantet/optimize/change_impl.h"
#include "scantet/optimize/place_search_impl.h"
#include "scantet/optimize/surface_guard_impl.h"

namespace scantet::optimize {

/// Looks for vertices that can be done without; keeps its buffers.
class Contraction {
 public:
  Contraction(const TetComplex& complex, SurfaceGuard& guard)
      : complex_(complex), guard_(guard), bound_(complex.judge().bound()), search_(complex.judge()) {}

  /// Puts into `best` that v goes into its neighbour u, if then no tet that v had is as sharp as best.sharpest. A
  /// vertex of the boundary goes along an edge of the boundary only, maybe into a vertex of a curve.
  void try_edge(VertexId v, VertexId u, Change& best);

  /// As try_edge(), but u moves to where the worst of the tets around it is best; on the boundary along the surface.
  /// That costs many times as much. Both must be inside, or both on the boundary.
  void try_edge_moving(VertexId v, VertexId u, Change& best);

 private:
  bool keeps_topology(VertexId v, VertexId u);
  std::optional<Lid> lid_without(VertexId v, VertexId u) const;
  double rate_facets(VertexId v, VertexId u);
  void add_moved(const Fan& fan, VertexId without, VertexId u);
  void add_tets(VertexId v, VertexId u);
  Place place_inside(VertexId v, VertexId u);
  Place place_on_surface(VertexId v, VertexId u);

  const TetComplex& complex_;
  SurfaceGuard& guard_;
  double bound_;
  Fan fan_;    // of v
  Fan other_;  // of u
  PlaceSearch search_;
  std::vector<NewTet> added_;
  Facets facets_;
  Facets moved_facets_;
  std::vector<VertexId> near_v_;
  std::vector<VertexId> near_edge_;
};

}  // namespace scantet::optimize
