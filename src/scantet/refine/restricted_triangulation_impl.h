// Private: the Delaunay triangulation of the sample with its restrictions to O and ∂O kept up to date.
#pragma once

#include <vector>

#include "scantet/refine/surface_balls.h"
#include "scantet/refine/triangulation_impl.h"

namespace scantet::refine {

struct SamplePoint {
  Point point;
  bool on_boundary = false;
};

/// The cells that a new point would replace, and the facets around them.
struct ConflictZone {
  std::vector<CellHandle> cells;
  std::vector<Facet> facets;  ///< as seen from inside the zone
};

/// D(P), D|O(P): cells whose circumcentre is inside, and D|∂O(P): facets with surface balls (paper, Definition 4).
class RestrictedTriangulation {
 public:
  explicit RestrictedTriangulation(const Domain& domain) : domain_(domain) {}

  /// Triangulates the points and classifies everything. Duplicates are dropped.
  /// Returns false if the points do not span space: then nothing is classified.
  bool build(const std::vector<SamplePoint>& points);

  /// The conflict zone of p, searched from `near` and, failing that, from wherever p is. Empty if p is a vertex.
  void find_zone(const Point& p, CellHandle near, ConflictZone& zone) const;

  /// Inserts p into its zone and classifies the new cells and facets.
  void insert(const SamplePoint& p, const ConflictZone& zone);

  /// Slots of the cells, and heads of the ball chains, that the last build or insert made.
  const std::vector<std::uint32_t>& new_cells() const { return new_cells_; }
  const std::vector<std::uint32_t>& new_balls() const { return new_balls_; }

  CellHandle cell(std::uint32_t slot) const { return cells_[slot].handle; }
  bool cell_alive(std::uint32_t slot, std::uint32_t serial) const { return cells_[slot].serial == serial; }
  std::uint32_t cell_serial(std::uint32_t slot) const { return cells_[slot].serial; }
  std::size_t slot_count() const { return cells_.size(); }
  const SurfaceBalls& balls() const { return balls_; }
  const Triangulation& triangulation() const { return triangulation_; }
  std::uint64_t vertex_count() const { return vertex_count_; }

 private:
  struct CellSlot {
    CellHandle handle;
    std::uint32_t serial = 0;  // 0 when free
  };

  void enter(CellHandle cell);
  void leave(CellHandle cell);
  void classify_facet(CellHandle cell, int i);
  void remove_balls(CellHandle cell, int i);
  Segment dual(CellHandle cell, int i) const;
  void set_vertex(VertexHandle vertex, bool on_boundary);

  const Domain& domain_;
  Triangulation triangulation_;
  std::vector<CellSlot> cells_;
  std::vector<std::uint32_t> free_cells_;
  std::uint32_t last_serial_ = 0;
  std::uint64_t vertex_count_ = 0;
  SurfaceBalls balls_;
  std::vector<std::uint32_t> new_cells_;
  std::vector<std::uint32_t> new_balls_;
  std::vector<CellHandle> star_;
  Crossings crossings_;
};

}  // namespace scantet::refine
