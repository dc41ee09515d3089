// The oracle of a trilinear field, however its heights are stored. A query goes to index space, where the cells are
// unit cubes. region_at looks up the sign of the block of 2³ cells and evaluates the cell only where it is mixed.
// crossings answers at once where all blocks around the segment have one sign. Else it walks the segment's cells,
// skipping larger blocks of one sign; in a cell the field along the segment is a cubic, whose sign changes are all
// found (bernstein_cubic.h).
//
// Agreement with region_at does not hang on rounding: the walk carries the region along, from region_at(source), and
// ends with region_at(target); the cubics of the cells that hold the ends have just these values there. A cell's cubic
// may only say where the region changes in between. Where two evaluations of one point in neighbouring cells differ in
// sign, the change is put at that point, whose height is zero to rounding. A touch of the level is no change.
//
// Crossings are mapped to the world from the index of the cell plus a local coordinate, not along the segment: their
// error is a few ulps of a world coordinate, however long the segment is.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "scantet/base/api.h"
#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/image/crossing_writer.h"
#include "scantet/image/surface_scan.h"
#include "scantet/image/trilinear_cells.h"
#include "scantet/topology/level_topology.h"

namespace SCANTET_API scantet {

/// The open set where a trilinear field of heights is above zero; region 1. Queries take world mm.
///
/// Field, whose nodes and cells have the indices of HeightGrid, gives
///   size()              nodes along each axis, without the padding
///   corners(i, j, k)    CellHeights of a cell
///   outside_height()    ≤ 0, of the padding and beyond
///   small(cell), fine(cell), coarse(cell)    BlockSign of the block of that size that holds the cell (block_signs.h)
///   between(a, b)       BlockSign of all cells in the box between two, as sign_between() has it
///   block_counts()      fine blocks along each axis: size() / 8, rounded down, and one more
///   shared(cell)        if parts are left out or filled: the SharedCell there, or null
/// and is immutable. Source: paper, section 3.
template <class Field>
class TrilinearDomain final : public Domain {
 public:
  /// frame: index to world. value_range: > 0, what residual_at() is relative to. make_topology(field): gives the
  /// field's LevelTopology; called at once, with the field where it stays, which lives as long as the domain. If that
  /// was cancelled, nothing may be asked of the domain. Throws what make_topology throws.
  template <class MakeTopology>
  TrilinearDomain(const Frame& frame, double value_range, Field field, const MakeTopology& make_topology)
      : frame_(frame), value_range_(value_range), field_(std::move(field)), topology_(make_topology(field_)) {}
  TrilinearDomain(const TrilinearDomain&) = delete;
  TrilinearDomain& operator=(const TrilinearDomain&) = delete;

  Box bounds() const override {
    const auto& size = field_.size();
    return frame_.world_box({-1, -1, -1}, {double(size[0]), double(size[1]), double(size[2])});
  }

  Region region_at(const Point& p) const override { return Region{inside_at(frame_.to_index(p))}; }

  void crossings(const Segment& segment, Crossings& out) const override {
    find_places(segment, out);
    for (Crossing& crossing : out) crossing.components = topology_.components_at(frame_.to_index(crossing.point));
  }

  /// Points where lines parallel to the grid's axes, at most spacing_mm apart, cross the boundary.
  /// Throws Error: usage.spacing (spacing_mm is not > 0, or under a thousandth of a voxel's edge).
  void surface_candidates(double spacing_mm, const PointSink& sink) const override {
    std::array<int, 3> divisions;
    for (int axis = 0; axis < 3; ++axis) {
      const double lines = std::ceil(frame_.spacing_mm(axis) / spacing_mm);
      if (!(spacing_mm > 0 && lines <= kMostDivisions)) {
        throw Error(Fault::usage, "usage.spacing",
                    "a spacing of " + number_text(spacing_mm) + " mm between surface points",
                    "ask for more than " + number_text(frame_.spacing_mm(axis) / kMostDivisions) + " mm");
      }
      divisions[axis] = std::max(1, static_cast<int>(lines));
    }
    SurfaceScan<Field>(field_, frame_, divisions).run(sink);
  }

  std::vector<Component> components() const override { return topology_.components(); }

  void size_hints(const SizeHintSink& sink) const override {
    for (const SizeHint& feature : topology_.size_hints()) sink(feature);
  }

  void narrow_ways(LevelGround ground, const NarrowWaySink& sink) const override {
    topology_.narrow_ways(ground, sink);
  }

  std::vector<Misplaced> misplaced(const MeshBoundary& boundary, const PlaceFilter& is_asked) const override {
    return topology_.misplaced(boundary(1), is_asked);
  }

  Patch patch_at(const Point& p) const override { return {{kOutside, 1}, topology_.components_at(frame_.to_index(p))}; }

  std::optional<double> residual_at(const Point& p) const override {
    return std::abs(height_at(frame_.to_index(p))) / value_range_;
  }

  const BoundaryCells* boundary_cells() const override { return &cells_; }

 private:
  static constexpr int kMostDivisions = 1000;  // lines per voxel: far below any feature of a trilinear field

  /// The crossings, but for what meets there.
  void find_places(const Segment& segment, Crossings& out) const {
    out.clear();
    Vec from = frame_.to_index(segment.source);
    Vec to = frame_.to_index(segment.target);
    // An end that is cut off lies on the box, where the height is not above zero: outside, as the end itself.
    const bool whole = in_padded_box(from, field_.size()) && in_padded_box(to, field_.size());
    if (!whole && !clip_to_padded_box(from, to, field_.size())) return;
    const CellIndex target_cell = cell_of(to, field_.size());
    const CellIndex source_cell = cell_of(from, field_.size());
    const bool within = source_cell == target_cell;
    if ((within ? field_.small(target_cell) : field_.between(source_cell, target_cell)) != BlockSign::mixed) return;
    const auto inside_at_target = [&] { return inside_at(to); };
    CrossingWriter writer(frame_, target_cell, inside_at_target, out);
    if (within) {
      if (const SharedCell* shared = shared_cell(field_, target_cell)) {
        return writer.pass_shared_target(*shared, from, to);
      }
      return writer.pass_target_cell(field_.corners(target_cell[0], target_cell[1], target_cell[2]), from, to);
    }
    for (CellWalk walk(from, to, field_.size());; walk.advance()) {
      pass(walk, writer);
      if (walk.last()) break;
    }
  }

  double height_at(const Vec& index) const {
    if (!in_padded_box(index, field_.size())) return field_.outside_height();
    const CellIndex cell = cell_of(index, field_.size());
    const SharedCell* shared = shared_cell(field_, cell);
    return trilinear(shared != nullptr ? shared->heights : field_.corners(cell[0], cell[1], cell[2]),
                     local_in(cell, index));
  }

  bool inside_at(const Vec& index) const {
    if (!in_padded_box(index, field_.size())) return false;
    const CellIndex cell = cell_of(index, field_.size());
    const BlockSign sign = field_.small(cell);
    if (sign != BlockSign::mixed) return sign == BlockSign::inside;
    if (const SharedCell* shared = shared_cell(field_, cell)) return shared->inside(local_in(cell, index));
    return trilinear(field_.corners(cell[0], cell[1], cell[2]), local_in(cell, index)) > 0;
  }

  // The walk's cell, or the largest block of one sign around it.
  template <class Writer>
  void pass(CellWalk& walk, Writer& writer) const {
    const CellIndex& cell = walk.cell();
    if (const BlockSign fine = field_.fine(cell); fine != BlockSign::mixed) {
      const bool whole = field_.coarse(cell) != BlockSign::mixed;
      walk.find_exit_of_block(whole ? kCoarseShift : kFineShift);
      return writer.pass_uniform(walk, fine == BlockSign::inside);
    }
    walk.find_exit();
    const BlockSign small = field_.small(cell);
    if (small != BlockSign::mixed) return writer.pass_uniform(walk, small == BlockSign::inside);
    if (const SharedCell* shared = shared_cell(field_, cell)) return writer.pass_shared(walk, *shared);
    writer.pass_cell(walk, field_.corners(cell[0], cell[1], cell[2]));
  }

  Frame frame_;
  double value_range_;
  Field field_;
  LevelTopology topology_;  // made at once: were it made at the first question, that could come in a parallel loop
  TrilinearCells<Field> cells_{field_, frame_};
};

}  // namespace scantet
