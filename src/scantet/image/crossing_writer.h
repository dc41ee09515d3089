// What a walk through cells makes of their cubics: the crossings of a segment.
#pragma once

#include <optional>
#include <utility>

#include "scantet/base/api.h"
#include "scantet/base/frame.h"
#include "scantet/domain/domain.h"
#include "scantet/field/shared_cells.h"

namespace SCANTET_API scantet {

/// Turns the cells of a walk, one by one, into crossings. It carries the region along, from that of the source to
/// `inside_at_target`, which is asked for only where the last cell is not the target's own. Cells come in the order of
/// the walk, all of them, but in blocks where these are of one sign. Points are in voxel units.
template <class InsideAtTarget>
class CrossingWriter {
 public:
  /// frame: index to world. target_cell: the cell that holds the target. inside_at_target(): whether the target is
  /// inside. out: crossings are added to it, without the components that meet there. All but target_cell are kept by
  /// reference, and outlive the writer.
  CrossingWriter(const Frame& frame, const CellIndex& target_cell, const InsideAtTarget& inside_at_target,
                 Crossings& out)
      : frame_(frame), target_cell_(target_cell), inside_at_target_(inside_at_target), out_(out) {}

  /// Passes a cell or a block wholly of one sign, between the walk's entry and exit. Pre: the walk's exit from it is
  /// found, here and below.
  void pass_uniform(const CellWalk& walk, bool inside) {
    start(inside);
    if (inside != inside_) emit(walk.entry());
    if (walk.last() && at_end(walk, inside) != inside_) emit(walk.exit());
  }

  /// Passes a cell with these heights at its corners, between the walk's entry and exit.
  void pass_cell(const CellWalk& walk, const CellHeights& heights) {
    if (!has_both_signs(heights)) return pass_uniform(walk, heights[0] > 0);
    pass_part(walk.cell(), heights, walk.entry(), walk.exit(), [&](const BernsteinCubic& cubic) {
      return walk.last() ? at_end(walk, cubic[3] > 0) : positive_before_end(cubic, inside_);
    });
  }

  /// Takes the whole of a segment that does not leave the target's cell.
  void pass_target_cell(const CellHeights& heights, const Vec& from, const Vec& to) {
    if (has_both_signs(heights))
      pass_part(target_cell_, heights, from, to, [](const BernsteinCubic& cubic) { return cubic[3] > 0; });
  }

  /// Passes a shared cell, as pass_cell() does others.
  void pass_shared(const CellWalk& walk, const SharedCell& cell) {
    const Vec exit = walk.exit();
    if (!walk.last()) return pass_shared_part(cell, walk.entry(), exit, std::nullopt);
    pass_shared_part(cell, walk.entry(), exit, at_end(walk, cell.inside(local_in(cell.cell, exit))));
  }
  /// Takes the whole of a segment in a shared cell, as pass_target_cell() does in others.
  void pass_shared_target(const SharedCell& cell, const Vec& from, const Vec& to) {
    pass_shared_part(cell, from, to, cell.inside(local_in(cell.cell, to)));
  }

 private:
  /// Takes the part of a cell from entry to exit; inside_at_exit(cubic) tells whether the exit is inside.
  template <class InsideAtExit>
  void pass_part(const CellIndex& cell, const CellHeights& heights, const Vec& entry, const Vec& exit,
                 const InsideAtExit& inside_at_exit) {
    const Vec a = local_in(cell, entry);
    const Vec b = local_in(cell, exit);
    const BernsteinCubic cubic = heights_along(heights, a, b);
    start(cubic[0] > 0);
    const SignChanges changes = sign_changes(cubic, inside_, inside_at_exit(cubic));
    const Vec corner{double(cell[0]), double(cell[1]), double(cell[2])};
    for (int i = 0; i < changes.count; ++i) emit(corner + lerp(a, b, changes.t[i]));
  }

  /// Takes all sign changes of the field as it was read, but for those around stretches that are left out or filled.
  /// inside_at_end: known only where the segment ends.
  void pass_shared_part(const SharedCell& cell, const Vec& entry, const Vec& exit, std::optional<bool> inside_at_end) {
    const Vec a = local_in(cell.cell, entry);
    const Vec b = local_in(cell.cell, exit);
    const BernsteinCubic cubic = heights_along(cell.heights, a, b);
    start(cell.inside(a, cubic[0] > 0));
    const bool from = side_of(cell, a, cubic[0] > 0, inside_);
    const bool to = inside_at_end ? side_of(cell, b, cubic[3] > 0, *inside_at_end) : positive_before_end(cubic, from);
    const SignChanges changes = sign_changes(cubic, from, to);
    const Vec corner{double(cell.cell[0]), double(cell.cell[1]), double(cell.cell[2])};
    const auto go_on = [&](double t, bool inside) {
      if (inside != inside_) emit(corner + lerp(a, b, t));
    };
    bool above = from;
    for (int i = 0; i <= changes.count; ++i, above = !above) {
      const double begin = i == 0 ? 0 : changes.t[i - 1];
      const double end = i == changes.count ? 1 : changes.t[i];
      if (end > begin && (above || cell.filled != 0)) {
        pass_stretch(cell, a, b, begin, end, above, go_on);
      } else if (above || cell.filled == 0) {
        go_on(begin, above && inside_);
      }
    }
    if (inside_at_end) go_on(1, *inside_at_end);
  }

  /// Whether the field as it was read is above the level at a point: as its height says, unless rounding did, and only
  /// the other side goes with what is known of the point.
  static bool side_of(const SharedCell& cell, const Vec& u, bool above, bool inside) {
    return cell.inside(u, above) != inside && cell.inside(u, !above) == inside ? !above : above;
  }

  /// Takes a stretch above the level, or one that is not. Where components touch at a point of it, which is a saddle at
  /// the level, they part.
  template <class GoOn>
  static void pass_stretch(const SharedCell& cell, const Vec& a, const Vec& b, double begin, double end, bool above,
                           const GoOn& go_on) {
    constexpr double kWithin = 1e-3;  // of the stretch, off its ends: there heights are too small to tell
    constexpr int kBisections = 50;
    const auto inside = [&](double t) { return cell.inside(lerp(a, b, t), above); };
    double low = begin + kWithin * (end - begin);
    double high = end - kWithin * (end - begin);
    const bool first = inside(low);
    go_on(begin, first);
    if (inside(high) == first) return;
    for (int n = 0; n < kBisections; ++n) {
      const double middle = 0.5 * (low + high);
      (inside(middle) == first ? low : high) = middle;
    }
    go_on(high, !first);
  }

  void start(bool inside) { inside_ = std::exchange(started_, true) ? inside_ : inside; }

  bool at_end(const CellWalk& walk, bool inside_by_cell) const {
    return walk.last() && walk.cell() != target_cell_ ? inside_at_target_() : inside_by_cell;
  }

  void emit(const Vec& index) {
    out_.push_back({frame_.to_world(index), Region{inside_}, Region{!inside_}});
    inside_ = !inside_;
  }

  const Frame& frame_;
  CellIndex target_cell_;
  const InsideAtTarget& inside_at_target_;
  Crossings& out_;
  bool inside_ = false;
  bool started_ = false;
};

}  // namespace scantet
