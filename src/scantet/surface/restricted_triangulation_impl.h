// Private: the Delaunay triangulation of the sample with its restrictions to O and ∂O kept up to date.
#pragma once

#include <algorithm>
#include <vector>

#include "scantet/delaunay/bulk_insertion_impl.h"
#include "scantet/delaunay/inserter_impl.h"
#include "scantet/delaunay/triangulation_impl.h"
#include "scantet/surface/disk_notes_impl.h"
#include "scantet/surface/junctions_impl.h"
#include "scantet/surface/surface_balls.h"

namespace scantet::engine {

/// The Delaunay triangulation D(P) and its restrictions (paper, Definition 4): D|O(P), the cells whose circumcentre is
/// inside, and D|∂O(P), the facets with surface balls.
class RestrictedTriangulation {
 public:
  explicit RestrictedTriangulation(const Domain& domain);

  void set_junctions(Junctions junctions) { junctions_ = std::move(junctions); }
  const Junctions& junctions() const { return junctions_; }

  /// Inserts the points and classifies all cells and facets, on several threads. Duplicates are dropped. Returns false
  /// if the points do not span space: then nothing is classified.
  bool build(std::vector<SamplePoint> points, Progress& progress);
  void insert_points(std::vector<SamplePoint> points, Progress& progress, const SeedLattice& lattice = {}) {
    insert_in_bulk(std::move(points), t_, progress, lattice);
  }
  bool classify();

  const Triangulation& triangulation() const { return t_; }
  Triangulation& triangulation() { return t_; }
  const SurfaceBalls& balls() const { return balls_; }
  SurfaceBalls& balls() { return balls_; }
  const DiskNotes& disks() const { return disks_; }
  DiskNotes& disks() { return disks_; }
  bool cell_alive(CellId c, std::uint32_t generation) const {
    return t_.is_cell(c) && t_.info(c).generation == generation;
  }
  std::uint64_t vertex_count() const;
  /// The largest of the balls of a facet and of one more, `ball`, unless that is kNone; kNone if there is none.
  std::uint32_t largest_ball(FacetCode facet, std::uint32_t ball) const;

  /// Notes that the facets around a vertex have changed: whether they form a disk is to be asked (check_disks).
  void question(PointId v) { question(v, questions_); }
  /// Puts a tet on the side of another region, and its vertices in question.
  void change_side(CellId c, Region region);
  /// How often that was done.
  std::uint64_t changes_of_sides() const { return changes_of_sides_; }
  /// The vertices on ∂O of which that is to be asked since this was called last, and of which it is not known by now;
  /// ascending.
  std::vector<PointId> take_questions();
  /// The vertices of which that was to be asked at any time since this was called last, ascending: all others have the
  /// facets that they had.
  std::vector<PointId> take_changed();

 private:
  friend class Editor;
  /// The same into the list of whoever works on the vertex.
  void question(PointId v, std::vector<PointId>& list) {
    if (disks_.question(v)) list.push_back(v);
  }
  /// Facets whose dual edges the domain is asked about in one call.
  struct DualEdges {
    std::vector<FacetCode> facets;
    std::vector<Segment> edges;
    CrossingLists crossings;  // of each edge

    void clear() {
      facets.clear();
      edges.clear();
    }
  };
  /// Finds the regions of the cells, which the domain is asked for in one call. centres, regions: memory to reuse.
  void classify_cells(const std::vector<CellId>& cells, std::vector<Point>& centres, std::vector<Region>& regions);
  void classify_vertex(PointId v);
  /// Adds the facet unless it has a corner: then its dual edge lies outside of the bounds.
  void add_dual(FacetCode facet, DualEdges& duals) const;
  /// The crossings of the i-th dual edge, as balls without a place in the pool.
  void find_balls(const DualEdges& duals, std::size_t i, std::vector<SurfaceBall>& out) const;
  void link_balls(const std::vector<std::vector<SurfaceBall>>& found);
  Segment dual(CellId c, int i) const;
  bool is_near(const Point& circumcentre) const { return squared_distance(circumcentre, center_) <= squared_reach_; }

  const Domain& domain_;
  Box bounds_;
  Point center_;  // of the bounds
  double squared_reach_;
  Triangulation t_;
  SurfaceBalls balls_;
  Junctions junctions_;
  DiskNotes disks_;
  std::vector<PointId> questions_;
  std::vector<PointId> changed_;  // and taken out of questions_ by now
  std::uint64_t changes_of_sides_ = 0;
};

/// Inserts points one by one and classifies what each changes: in the whole triangulation or in one part of it.
class Editor {
 public:
  explicit Editor(RestrictedTriangulation& t) : t_(t), inserter_(t.t_), balls_(t.balls_) {}
  /// Works in one part, with slots for so many vertices. parts: see Inserter.
  Editor(RestrictedTriangulation& t, VertexParts& parts, PartId part, std::size_t vertices);
  Editor(Editor&&) = default;

  /// Gives back the slots that are left, and classifies the facets that could not be classified for lack of slots.
  /// Editors retire one after another, in the order of their parts.
  void retire();

  Inserter::Found find_zone(const Point& p, CellId near) { return inserter_.find_zone(p, near, zone_); }
  const ConflictZone& zone() const { return zone_; }
  bool owns(CellId c) const { return inserter_.owns(c); }
  bool is_whole() const { return inserter_.part() == Inserter::kWhole; }
  /// Whether the zone can be filled with the slots there are.
  bool has_room() const { return !exhausted_ && inserter_.has_vertex() && inserter_.has_room_for(zone_); }

  /// Inserts p into the zone found last. Returns its vertex.
  PointId insert(const SamplePoint& p);

  /// The cells, and heads of the ball chains, that the last insertion (or retire) made.
  const std::vector<CellId>& new_cells() const { return inserter_.new_cells(); }
  const std::vector<std::uint32_t>& new_balls() const { return new_balls_; }

 private:
  void remove_balls(CellId c, int i);
  /// Asks about the dual edges of the facets, and gives these their balls.
  void classify_facets();
  void add_balls(FacetCode facet);

  RestrictedTriangulation& t_;
  Inserter inserter_;
  BallStock balls_;
  ConflictZone zone_;
  bool exhausted_ = false;
  std::vector<PointId> questions_;      // handed on when it retires
  std::vector<FacetCode> late_facets_;  // not classified for want of balls
  std::vector<std::uint32_t> new_balls_;
  std::vector<SurfaceBall> found_;
  RestrictedTriangulation::DualEdges duals_;
  std::vector<Point> centres_;
  std::vector<Region> regions_;
};

}  // namespace scantet::engine
