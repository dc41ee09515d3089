// Private: the Delaunay triangulation of a growing set of points, on which several threads can work, each in a part of
// space.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "scantet/base/large_pages.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/delaunay/orthosphere.h"

namespace scantet::engine {

inline constexpr std::uint32_t kNone = 0xffffffff;

using PointId = std::uint32_t;
using CellId = std::uint32_t;
using PartId = std::uint8_t;
/// The part of space that each vertex slot belongs to, while several threads work.
using VertexParts = std::vector<PartId>;

/// What the triangulation keeps of a vertex: 32 bytes.
struct Vertex {
  Point point;
  CellId cell = kNone;  ///< one that has it; kNone: not in the triangulation
};

/// What the restrictions to O and ∂O keep of a vertex.
struct VertexInfo {
  Patch patch;                 ///< of ∂O, for a vertex on one; not known where the domain cannot tell
  std::uint8_t dimension = 3;  ///< as Stratum::dimension

  bool on_boundary() const { return dimension < 3; }
};

/// A facet of a cell as a number: 4 · cell + index of the vertex opposite to it.
using FacetCode = std::uint32_t;

/// A tet and all that a search for conflicts reads of it: one cache line.
struct alignas(64) Cell {
  std::array<PointId, 4> vertex;      ///< positively oriented; the first is kNone if the slot is free
  std::array<FacetCode, 4> neighbor;  ///< each facet as the tet across has it; kNone: there is no such tet
  Point circumcentre;                 ///< see Triangulation::find_spheres; with weights the orthocentre
  float
      surely_inside;  ///< squared distance from the circumcentre: points nearer than that are inside the circumsphere,
  float surely_outside;  ///< points farther than that are outside; in between exact arithmetic decides
};
static_assert(sizeof(Cell) == 64);

/// What the restrictions to O and ∂O keep of a cell: 24 bytes.
struct CellInfo {
  std::uint32_t generation = 0;  ///< counts the uses of this slot, to tell whether a tet still exists
  Region region = kOutside;      ///< at the circumcentre
  std::array<std::uint32_t, 4> balls{kNone, kNone, kNone, kNone};  ///< first surface ball of each facet, if any
};

/// The cells that a new point would replace, and the facets around them, as seen from inside the zone.
struct ConflictZone {
  std::vector<CellId> cells;
  std::vector<FacetCode> facets;
};

/// The Delaunay triangulation of the points and of four corners. The corners are so far away that no place within the
/// bounds is nearer to a corner than to a point: within the bounds its Voronoi diagram is that of the points alone.
/// There are no infinite cells; every point lies inside of the tet of the corners.
///
/// Points may have weights: then it is the Delaunay triangulation of weighted points (a regular triangulation), cells
/// have orthogonal spheres in place of circumspheres, and distances are power distances. No point may lie in the ball
/// of another.
class Triangulation {
 public:
  static constexpr PointId kCorners = 4;

  /// bounds: not empty; all points will lie in it.
  explicit Triangulation(const Box& bounds);

  const Cell& cell(CellId c) const { return cells_[c]; }
  const CellInfo& info(CellId c) const { return infos_[c]; }
  CellInfo& info(CellId c) { return infos_[c]; }
  const Vertex& vertex(PointId v) const { return vertices_[v]; }
  Vertex& vertex(PointId v) { return vertices_[v]; }
  const VertexInfo& vertex_info(PointId v) const { return vertex_infos_[v]; }
  VertexInfo& vertex_info(PointId v) { return vertex_infos_[v]; }
  const Point& point(PointId v) const { return vertices_[v].point; }
  std::array<Point, 4> points_of(CellId c) const {
    const auto& v = cells_[c].vertex;
    return {point(v[0]), point(v[1]), point(v[2]), point(v[3])};
  }

  /// The weights, mm², of the first vertices; all others have none. Pre: there are no vertices yet.
  void set_weights(std::vector<double> weights) { weights_ = std::move(weights); }
  bool has_weights() const { return !weights_.empty(); }
  double weight(PointId v) const { return v - kCorners < weights_.size() ? weights_[v - kCorners] : 0; }
  WeightedPoint weighted_point(PointId v) const { return {point(v), weight(v)}; }
  std::array<WeightedPoint, 4> weighted_points_of(CellId c) const {
    const auto& v = cells_[c].vertex;
    return {weighted_point(v[0]), weighted_point(v[1]), weighted_point(v[2]), weighted_point(v[3])};
  }

  /// The number of slots, of which some are free.
  CellId cell_slots() const { return static_cast<CellId>(cells_.size()); }
  PointId vertex_slots() const { return static_cast<PointId>(vertices_.size()); }
  bool is_cell(CellId c) const { return cells_[c].vertex[0] != kNone; }
  bool is_vertex(PointId v) const { return v >= kCorners && vertices_[v].cell != kNone; }
  /// Whether the tet has a corner: then its circumcentre is out of bounds.
  bool has_corner(CellId c) const {
    const auto& v = cells_[c].vertex;
    return std::min({v[0], v[1], v[2], v[3]}) < kCorners;
  }
  /// Whether all vertices of the tet lie on ∂O: then it can change sides and no vertex off ∂O comes to the surface.
  bool is_on_boundary(CellId c) const;

  /// Has the processor fetch the cells across the facets into its cache.
  void prefetch_neighbors(CellId c) const {
    for (const FacetCode across : cells_[c].neighbor) {
      if (across != kNone) __builtin_prefetch(&cells_[across / 4]);
    }
  }

  /// The index of a vertex in a cell that has it.
  int index_of(CellId c, PointId v) const {
    const auto& vertex = cells_[c].vertex;
    return vertex[0] == v ? 0 : vertex[1] == v ? 1 : vertex[2] == v ? 2 : 3;
  }
  /// The cells around a vertex. Reads only cells that have it.
  void star_of(PointId v, std::vector<CellId>& star) const;

  /// The number of vertices, not counting the corners.
  std::uint64_t vertex_count() const { return vertices_.size() - kCorners - free_vertices_.size(); }

  /// Makes room for so many vertices, which are to be inserted, and for those that follow them.
  void reserve(std::size_t vertices);
  /// What has the system give the memory for the cells of so many vertices, for which there is room, until `enough` is
  /// true. It may run beside everything, also beside what reserves more.
  std::function<void(const std::atomic<bool>& enough)> populating(std::size_t vertices);

  /// Adds slots for so many vertices, each to be set before it is used, and returns the first. A vertex that was not
  /// inserted is given back with drop_vertex().
  PointId add_vertices(std::size_t count);
  /// One with the members' defaults.
  PointId add_vertex();
  void drop_vertex(PointId v) {
    if (v - kCorners < weights_.size()) weights_[v - kCorners] = 0;  // whoever gets the slot has no weight
    free_vertices_.push_back(v);
  }

  /// Numbers the cells anew, by their vertices and without gaps: neighbours in space become neighbours in memory. From
  /// then on each cell has an info and its lasting sphere.
  void renumber_cells();

  /// Computes up to and from which distance points are certainly inside and outside of the spheres. The circumcentres
  /// are right to some digits only, or NaN.
  void find_spheres(std::span<const CellId> cells);
  /// The same, but with circumcentres that are functions of the four points alone, right even if the tet is flat.
  void find_lasting_spheres(std::span<const CellId> cells);
  /// Whether the cell goes when p is inserted. weight: of p.
  bool in_conflict(CellId c, const Point& p, double weight = 0) const {
    const Cell& cell = cells_[c];
    const double squared = squared_distance(cell.circumcentre, p) - weight;
    if (squared > static_cast<double>(cell.surely_outside)) return false;
    if (squared < static_cast<double>(cell.surely_inside)) return true;
    return in_conflict_exactly(c, {p, weight});
  }

 private:
  friend class Inserter;
  friend class LatticeCore;
  CellId add_cell();
  void add_cells(std::size_t count);
  std::vector<CellId> take_cells(std::size_t count);
  void clear_cell(CellId c);
  std::vector<CellId> numbers_by_place(CellId& count) const;
  template <class PointsOf>
  void find_spheres_of(std::span<const CellId> cells, PointsOf points_of_cell);
  bool in_conflict_exactly(CellId c, const WeightedPoint& p) const;
  /// Whether a vertex of the cell may have a weight.
  bool may_have_weight(CellId c) const {
    return has_weights() && *std::ranges::min_element(cells_[c].vertex) < kCorners + weights_.size();
  }

  std::vector<double> weights_;  // of the first vertices
  LargeVector<Vertex> vertices_;
  LargeVector<VertexInfo> vertex_infos_;
  LargeVector<Cell> cells_;
  LargeVector<CellInfo> infos_;  // from renumber_cells() on
  std::vector<CellId> free_cells_;
  std::vector<PointId> free_vertices_;
};

/// The three vertices of the facet opposite to vertex i of a cell.
inline std::array<PointId, 3> facet_vertices(const Cell& cell, int i) {
  return {cell.vertex[(i + 1) & 3], cell.vertex[(i + 2) & 3], cell.vertex[(i + 3) & 3]};
}

}  // namespace scantet::engine
