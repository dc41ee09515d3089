// Private: inserts points into the triangulation, in the whole of it or in one part of space.
#pragma once

#include "scantet/delaunay/cell_set_impl.h"
#include "scantet/delaunay/edge_table_impl.h"
#include "scantet/delaunay/triangulation_impl.h"

namespace scantet::engine {

/// Inserts points. Every vertex but the corners belongs to a part. A tet is owned by a part if all of its vertices
/// belong to it, corners not counted. An inserter of a part replaces only tets that the part owns, and looks only at
/// tets that have a vertex of the part. Two tets that share a facet are never owned by different parts. So no inserter
/// changes what another one looks at, and inserters of different parts can work at the same time without locks.
class Inserter {
 public:
  static constexpr PartId kWhole = 255;

  /// Works on the whole triangulation, whose arrays grow as needed: no other inserter may exist.
  explicit Inserter(Triangulation& triangulation);
  /// Works in one part, with so many new slots for cells and vertices of its own. parts: must outlive this, and have a
  /// place for every vertex slot before the first search; those of inserted vertices are set.
  Inserter(Triangulation& triangulation, VertexParts& parts, PartId part, std::size_t cells, std::size_t vertices);
  Inserter(Inserter&&) = default;

  /// Gives back the slots that are left. Inserters give back one after another, in the order of their parts.
  void retire();

  enum class Found {
    zone,    ///< the zone is filled
    vertex,  ///< the point is a vertex already, or lies in the ball of one
    beyond   ///< the zone, or the way to it, leaves the part
  };
  /// Finds the conflict zone of p, searching from the cell `near`. If that is a free slot, the search starts anywhere.
  /// weight: of p, mm².
  Found find_zone(const Point& p, CellId near, ConflictZone& zone, double weight = 0);
  /// Walks from the cell `from`, which must exist, to the cell that contains p.
  Found locate(const Point& p, CellId from);
  /// The cell where the last search ended: it contains the point, or is near it.
  CellId last_seen() const { return last_seen_; }
  /// The cell that contains p, found from the cell `from`; where the way to it leaves the part, the last one on it.
  CellId cell_at(const Point& p, CellId from) {
    locate(p, from);
    return last_seen_;
  }

  /// Whether there are slots left for the tets that would fill this zone.
  bool has_room_for(const ConflictZone& zone) const;
  /// Whether there is a slot left for a vertex.
  bool has_vertex() const { return part_ == kWhole || !free_vertices_.empty(); }
  /// A free vertex slot. Pre: has_vertex.
  PointId take_vertex();
  /// Replaces the zone that find_zone found last by the tets around v, whose point is set. The caller computes their
  /// spheres before the next search.
  void insert(PointId v, const ConflictZone& zone);
  /// The tets that the last insertion made.
  const std::vector<CellId>& new_cells() const { return new_cells_; }
  CellId last_cell() const { return last_cell_; }
  void start_at(CellId c) { last_cell_ = c; }
  bool owns(CellId c) const {
    if (part_ == kWhole) return true;
    for (const PointId v : t_.cells_[c].vertex) {
      if (v >= Triangulation::kCorners && (*parts_)[v] != part_) return false;
    }
    return true;
  }
  PartId part() const { return part_; }

 private:
  bool grow(const WeightedPoint& p, CellId start, ConflictZone& zone);
  CellId take_cell();
  bool link_by_edges(const ConflictZone& zone);
  void link_by_turning(PointId v, FacetCode inner, CellId fresh);
  bool may_cross(const Cell& cell, int i) const;

  Triangulation& t_;
  VertexParts* parts_;  // null in the whole
  PartId part_;
  CellSet in_zone_;
  CellId last_cell_ = kNone;
  CellId last_seen_ = kNone;
  std::vector<CellId> free_cells_;
  CellId fresh_cell_ = 0;  // from here to fresh_end_: slots of the part that were never used, not even cleared
  CellId fresh_end_ = 0;
  std::vector<PointId> free_vertices_;
  std::vector<CellId> new_cells_;
  EdgeTable edges_;
  std::vector<std::array<EdgeTable::Number, 2>> ends_;  // of the edges that the new tets turn to each other
};

}  // namespace scantet::engine
