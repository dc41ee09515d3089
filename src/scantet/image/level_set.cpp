// A query goes to index space, where the cells are unit cubes. region_at looks up the sign of the block of 2³ cells and
// evaluates the cell only where it is mixed. crossings answers at once where all blocks around the segment have one
// sign. Else it walks the segment's cells, skipping larger blocks of one sign; in a cell the field along the segment is
// a cubic, whose sign changes are all found (bernstein_cubic.h).
//
// Agreement with region_at does not hang on rounding: the walk carries the region along, from region_at(source), and
// ends with region_at(target); the cubics of the cells that hold the ends have just these values there. A cell's cubic
// may only say where the region changes in between. Where two evaluations of one point in neighbouring cells differ in
// sign, the change is put at that point, whose height is zero to rounding.
//
// Crossings are mapped to the world from the index of the cell plus a local coordinate, not along the segment: their
// error is a few ulps of a world coordinate, however long the segment is.
#include "scantet/image/level_set.h"

#include <charconv>

#include "scantet/base/error.h"
#include "scantet/image/cell_walk.h"
#include "scantet/image/level_topology.h"
#include "scantet/image/padded_grid.h"
#include "scantet/image/sign_pyramid.h"
#include "scantet/image/surface_scan.h"
#include "scantet/image/trilinear_cell.h"

namespace scantet {
namespace {

constexpr Region kInside = 1;

/// The shortest text that reads back as the same number.
std::string text(double value) {
  std::array<char, 32> buffer;
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

std::string name_of(InsideSide side) {
  return side == InsideSide::above ? "above" : "below";
}

Region region_of(bool inside) {
  return inside ? kInside : kOutside;
}

/// Turns the cells of a walk, one by one, into crossings, carrying the region along from the first cell's at the source
/// to `inside_at_target`, asked for only where the last cell is not the target's own.
template <class InsideAtTarget>
class CrossingWriter {
 public:
  CrossingWriter(const Frame& frame, const CellIndex& target_cell, const InsideAtTarget& inside_at_target,
                 Crossings& out)
      : frame_(frame), target_cell_(target_cell), inside_at_target_(inside_at_target), out_(out) {}

  /// A cell or block wholly of one sign, between the walk's entry and exit.
  void pass_uniform(const CellWalk& walk, bool inside) {
    start(inside);
    if (inside != inside_) emit(walk.entry());
    if (walk.last() && at_end(walk, inside) != inside_) emit(walk.exit());
  }

  void pass_cell(const CellWalk& walk, const CellHeights& heights) {
    if (!has_both_signs(heights)) return pass_uniform(walk, heights[0] > 0);
    pass_part(walk.cell(), heights, walk.entry(), walk.exit(), [&](bool inside) { return at_end(walk, inside); });
  }

  /// The whole of a segment that does not leave the cell.
  void pass_target_cell(const CellHeights& heights, const Vec& from, const Vec& to) {
    if (has_both_signs(heights)) pass_part(target_cell_, heights, from, to, [](bool inside) { return inside; });
  }

 private:
  /// The part of a cell from entry to exit; inside_at_exit turns what the cell says of the exit into what holds.
  template <class InsideAtExit>
  void pass_part(const CellIndex& cell, const CellHeights& heights, const Vec& entry, const Vec& exit,
                 const InsideAtExit& inside_at_exit) {
    const Vec a = local_in(cell, entry);
    const Vec b = local_in(cell, exit);
    const BernsteinCubic cubic = heights_along(heights, a, b);
    start(cubic[0] > 0);
    const SignChanges changes = sign_changes(cubic, inside_, inside_at_exit(cubic[3] > 0));
    const Vec corner{double(cell[0]), double(cell[1]), double(cell[2])};
    for (int i = 0; i < changes.count; ++i) emit(corner + lerp(a, b, changes.t[i]));
  }

  void start(bool inside) {
    if (!started_) inside_ = inside;
    started_ = true;
  }

  bool at_end(const CellWalk& walk, bool inside_by_cell) const {
    return walk.last() && walk.cell() != target_cell_ ? inside_at_target_() : inside_by_cell;
  }

  void emit(const Vec& index) {
    out_.push_back({frame_.to_world(index), region_of(inside_), region_of(!inside_)});
    inside_ = !inside_;
  }

  const Frame& frame_;
  CellIndex target_cell_;
  const InsideAtTarget& inside_at_target_;
  Crossings& out_;
  bool inside_ = false;
  bool started_ = false;
};

template <class Voxel>
class LevelSet final : public Domain {
 public:
  LevelSet(const Scan& scan, const LevelSetSettings& settings, const Voxel* voxels)
      : scan_(scan), grid_(padded_grid(scan_, voxels, settings)), pyramid_(grid_), topology_(scan, settings) {}

  Box bounds() const override {
    return scan_.frame.world_box({-1, -1, -1}, {double(grid_.size[0]), double(grid_.size[1]), double(grid_.size[2])});
  }

  Region region_at(const Point& p) const override { return region_of(inside_at(scan_.frame.to_index(p))); }

  void crossings(const Segment& segment, Crossings& out) const override {
    out.clear();
    Vec from = scan_.frame.to_index(segment.source);
    Vec to = scan_.frame.to_index(segment.target);
    // An end that is cut off lies on the box, where the height is not above zero: outside, as the end itself.
    const bool whole = in_padded_box(from, grid_.size) && in_padded_box(to, grid_.size);
    if (!whole && !clip_to_padded_box(from, to, grid_.size)) return;
    const CellIndex target_cell = cell_of(to, grid_.size);
    const CellIndex source_cell = cell_of(from, grid_.size);
    const auto inside_at_target = [&] { return inside_at(to); };
    CrossingWriter writer(scan_.frame, target_cell, inside_at_target, out);
    if (source_cell == target_cell) {
      if (pyramid_.small(target_cell) != BlockSign::mixed) return;
      return writer.pass_target_cell(grid_.corners(target_cell[0], target_cell[1], target_cell[2]), from, to);
    }
    if (pyramid_.between(source_cell, target_cell) != BlockSign::mixed) return;
    for (CellWalk walk(from, to, grid_.size);; walk.advance()) {
      pass(walk, writer);
      if (walk.last()) break;
    }
  }

  void surface_candidates(double spacing_mm, const PointSink& sink) const override {
    std::array<int, 3> divisions;
    for (int axis = 0; axis < 3; ++axis) {
      const double lines = std::ceil(scan_.frame.spacing_mm(axis) / spacing_mm);
      if (!(spacing_mm > 0 && lines <= kMostDivisions)) {
        throw Error(Fault::usage, "usage.spacing", "a spacing of " + text(spacing_mm) + " mm between surface points",
                    "ask for more than " + text(scan_.frame.spacing_mm(axis) / kMostDivisions) + " mm");
      }
      divisions[axis] = std::max(1, static_cast<int>(lines));
    }
    SurfaceScan<Voxel>(grid_, pyramid_, scan_.frame, divisions).run(sink);
  }

  std::vector<Component> components() const override { return topology_.components(); }

  void features(const FeatureSink& sink) const override {
    for (const Feature& feature : topology_.features()) sink(feature);
  }

  BoundaryId boundary_at(const Point& p) const override { return topology_.boundary_at(scan_.frame.to_index(p)); }

  std::optional<double> residual_at(const Point& p) const override {
    return std::abs(height_at(scan_.frame.to_index(p))) / (scan_.max_value - scan_.min_value);
  }

 private:
  static constexpr int kMostDivisions = 1000;  // lines per voxel: far below any feature of a trilinear field

  double height_at(const Vec& index) const {
    if (!in_padded_box(index, grid_.size)) return grid_.outside_height;
    const CellIndex cell = cell_of(index, grid_.size);
    return trilinear(grid_.corners(cell[0], cell[1], cell[2]), local_in(cell, index));
  }

  bool inside_at(const Vec& index) const {
    if (!in_padded_box(index, grid_.size)) return false;
    const CellIndex cell = cell_of(index, grid_.size);
    const BlockSign sign = pyramid_.small(cell);
    if (sign != BlockSign::mixed) return sign == BlockSign::inside;
    return trilinear(grid_.corners(cell[0], cell[1], cell[2]), local_in(cell, index)) > 0;
  }

  /// The walk's cell, or the largest block of one sign around it.
  template <class Writer>
  void pass(CellWalk& walk, Writer& writer) const {
    const CellIndex& cell = walk.cell();
    if (const BlockSign fine = pyramid_.fine(cell); fine != BlockSign::mixed) {
      const bool whole = pyramid_.coarse(cell) != BlockSign::mixed;
      walk.find_exit_of_block(whole ? SignPyramid::kCoarseShift : SignPyramid::kFineShift);
      return writer.pass_uniform(walk, fine == BlockSign::inside);
    }
    walk.find_exit();
    const BlockSign small = pyramid_.small(cell);
    if (small != BlockSign::mixed) return writer.pass_uniform(walk, small == BlockSign::inside);
    writer.pass_cell(walk, grid_.corners(cell[0], cell[1], cell[2]));
  }

  Scan scan_;
  PaddedGrid<Voxel> grid_;
  SignPyramid pyramid_;
  LevelTopology topology_;  // made at once: were it made at the first question, that could come in a parallel loop
};

void check_level(const Scan& scan, const LevelSetSettings& settings) {
  const bool above = settings.inside == InsideSide::above;
  const double level = settings.level;
  const bool something_inside = above ? scan.max_value > level : scan.min_value < level;
  const bool something_outside = above ? scan.min_value <= level : scan.max_value >= level;
  if (std::isfinite(level) && something_inside && something_outside) return;
  const std::string low = text(scan.min_value);
  const std::string high = text(scan.max_value);
  if (scan.min_value == scan.max_value) {
    throw Error(Fault::input, "input.level", "level " + text(level) + ": every voxel of the scan has the value " + low,
                "a scan without contrast has no surface at any level; check that it is the right file");
  }
  const char* result = !std::isfinite(level) ? " is not a number"
                       : !something_inside   ? " leaves nothing inside"
                                             : " leaves nothing outside";
  throw Error(Fault::input, "input.level",
              "level " + text(level) + result + ": the values of the scan run from " + low + " to " + high +
                  " and inside is " + name_of(settings.inside) + " the level",
              "choose a level between " + low + " and " + high + "; `scantet info` suggests one");
}

}  // namespace

/// A value beyond the image that is strictly on the outside closes the surface within the padding. One equal to the
/// level (the default at a level equal to the smallest value) moves off it by 0.1 % of the range. One more than 1000
/// ranges off would make the field so steep that a crossing cannot be told to 1e-9 of the range.
LevelSetSettings checked_settings(const Scan& scan, LevelSetSettings settings) {
  check_level(scan, settings);
  constexpr double kNudge = 1e-3;
  constexpr double kSteepest = 1e3;
  const bool above = settings.inside == InsideSide::above;
  const double away = above ? -1 : 1;
  const double range = scan.max_value - scan.min_value;
  const double outside = settings.outside.value_or(above ? scan.min_value : scan.max_value);
  const double distance = away * (outside - settings.level);
  if (!(distance >= 0 && distance <= kSteepest * range)) {
    const double limit = settings.level + away * kSteepest * range;
    const char* fault = distance < 0 ? " is on the inside of level " : " is too far off level ";
    throw Error(Fault::usage, "usage.outside",
                "the outside value " + text(outside) + fault + text(settings.level) + " (inside is " +
                    name_of(settings.inside) + ")",
                "choose a value between " + text(std::min(settings.level, limit)) + " and " +
                    text(std::max(settings.level, limit)));
  }
  settings.outside = distance > 0 ? outside : settings.level + away * kNudge * range;
  return settings;
}

std::unique_ptr<Domain> make_level_set(const Scan& scan, const LevelSetSettings& settings) {
  const LevelSetSettings checked = checked_settings(scan, settings);
  return std::visit(
      [&]<class Voxel>(const Voxel* voxels) -> std::unique_ptr<Domain> {
        return std::make_unique<LevelSet<Voxel>>(scan, checked, voxels);
      },
      scan.voxels);
}

}  // namespace scantet
