// The cells of a trilinear field that its level set may be in.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/frame.h"
#include "scantet/domain/boundary_cells.h"
#include "scantet/field/block_signs.h"
#include "scantet/field/shared_cells.h"

namespace SCANTET_API scantet {

/// One surface: the boundary of where the field is above zero. Field: as for TrilinearDomain. Groups are rows of fine
/// blocks along x, and a cell's id is its CellIndex.
template <class Field>
class TrilinearCells final : public BoundaryCells {
 public:
  /// field, frame (index to world): outlive it.
  TrilinearCells(const Field& field, const Frame& frame) : field_(field), frame_(frame) {}

  std::size_t surfaces() const override { return 1; }

  std::size_t groups(std::size_t) const override {
    return static_cast<std::size_t>(field_.block_counts()[1]) * static_cast<std::size_t>(field_.block_counts()[2]);
  }

  void cells_of(std::size_t, std::size_t group, std::vector<BoundaryCell>& out) const override {
    constexpr int kBlocks = 1 << (kCoarseShift - kFineShift);
    const auto rows = static_cast<std::size_t>(field_.block_counts()[1]);
    const auto first_cell = [](std::size_t block) { return (static_cast<int>(block) << kFineShift) - 1; };
    for (int x = 0; x < field_.block_counts()[0]; ++x) {
      const CellIndex first{first_cell(static_cast<std::size_t>(x)), first_cell(group % rows),
                            first_cell(group / rows)};
      if (field_.fine(first) == BlockSign::mixed) {
        CellIndex last;
        for (int axis = 0; axis < 3; ++axis) {
          last[axis] = std::min(first[axis] + (1 << kFineShift), field_.size()[axis]) - 1;
        }
        add_cells(first, last, out);
      } else if (x % kBlocks == 0 && field_.coarse(first) != BlockSign::mixed) {
        x += kBlocks - 1;
      }
    }
  }

  void cells_in(std::size_t, const Box& box, std::vector<BoundaryCell>& out) const override {
    const auto [low, high] = frame_.index_box(box);
    CellIndex first;
    CellIndex last;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(high[axis] >= -1 && low[axis] <= field_.size()[axis])) return;
      // A face belongs to both of its cells.
      const double beyond = field_.size()[axis];
      first[axis] = std::max(floored(std::max(low[axis], -1.0) - kSlack), -1);
      last[axis] = std::min(floored(std::min(high[axis], beyond) + kSlack), field_.size()[axis] - 1);
    }
    add_cells(first, last, out);
  }

  bool may_hold(std::size_t, const BoundaryCell& cell, const Vec& low, const Vec& high) const override {
    const SharedCell* shared = shared_cell(field_, cell.id);
    return shared == nullptr || shared->may_hold_boundary(low, high);
  }

  Side side_of(std::size_t, std::span<const Point> hull) const override {
    Box indices;
    for (const Point& p : hull) indices.extend(frame_.to_index(p));
    Vec low = indices.min;
    Vec high = indices.max;
    const auto& size = field_.size();
    bool beyond = false;  // some of the box is off the padded box, where all is outside
    for (int axis = 0; axis < 3; ++axis) {
      const double end = size[axis];
      if (high[axis] < -1 || low[axis] > end) return Side::outside;
      beyond = beyond || low[axis] < -1 || high[axis] > end;
      low[axis] = std::clamp(low[axis], -1.0, end);
      high[axis] = std::clamp(high[axis], -1.0, end);
    }
    const Side side = side_within(low, high, hull);
    return beyond && side == Side::inside ? Side::unknown : side;
  }

 private:
  static constexpr double kSlack = 1e-9;  // voxels: more than rounding can be off

  /// Adds those of these cells that have both signs.
  void add_cells(const CellIndex& first, const CellIndex& last, std::vector<BoundaryCell>& out) const {
    for (int k = first[2]; k <= last[2]; ++k) {
      for (int j = first[1]; j <= last[1]; ++j) {
        for (int i = first[0]; i <= last[0]; ++i) {
          const CellIndex cell{i, j, k};
          if (field_.small(cell) != BlockSign::mixed) continue;
          const SharedCell* shared = shared_cell(field_, cell);
          const CellHeights heights = shared != nullptr ? shared->heights : field_.corners(i, j, k);
          if (!has_both_signs(heights)) continue;
          out.push_back({cell,
                         frame_.to_world({double(i), double(j), double(k)}),
                         {frame_.column(0), frame_.column(1), frame_.column(2)},
                         heights,
                         shared != nullptr});
        }
      }
    }
  }

  /// Of the part of a hull that is in a box of indices, in the padded box.
  Side side_within(const Vec& low, const Vec& high, std::span<const Point> hull) const {
    constexpr int kMostCells = 64;  // a larger box is for whoever asks to divide
    const CellIndex first = cell_of(low, field_.size());
    const CellIndex last = cell_of(high, field_.size());
    const BlockSign sign = first == last ? field_.small(first) : field_.between(first, last);
    if (sign != BlockSign::mixed) return sign == BlockSign::inside ? Side::inside : Side::outside;
    const auto along = [&](int axis) { return last[axis] - first[axis] + 1; };
    if (along(0) > kMostCells || along(1) > kMostCells || along(2) > kMostCells ||
        along(0) * along(1) * along(2) > kMostCells) {
      return Side::unknown;
    }
    Side all = Side::unknown;
    for (int k = first[2]; k <= last[2]; ++k) {
      for (int j = first[1]; j <= last[1]; ++j) {
        for (int i = first[0]; i <= last[0]; ++i) {
          const Side side = side_in_cell({i, j, k}, low, high, hull);
          if (side == Side::unknown || (all != Side::unknown && side != all)) return Side::unknown;
          all = side;
        }
      }
    }
    return all;
  }

  /// Of the part of a hull that is in a box of indices and in a cell. In what the cell has of the box, the field lies
  /// within its values at that part's corners; and off its affine part by no more than its other coefficients there.
  Side side_in_cell(const CellIndex& cell, const Vec& low, const Vec& high, std::span<const Point> hull) const {
    const BlockSign sign = field_.small(cell);
    if (sign != BlockSign::mixed) return sign == BlockSign::inside ? Side::inside : Side::outside;
    const SharedCell* shared = shared_cell(field_, cell);
    const CellHeights heights = shared != nullptr ? shared->heights : field_.corners(cell[0], cell[1], cell[2]);
    const Vec from = local_in(cell, low);
    const Vec to = local_in(cell, high);
    const CellHeights part = heights_between(heights, from, to);
    const auto [lowest, highest] = std::minmax_element(part.begin(), part.end());
    if (*highest <= 0) return shared == nullptr || shared->filled == 0 ? Side::outside : Side::unknown;
    if (*lowest > 0) return shared == nullptr || shared->dropped == 0 ? Side::inside : Side::unknown;
    if (shared != nullptr) return Side::unknown;
    const AffineBounds bounds(part);
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    const Vec corner{double(cell[0]), double(cell[1]), double(cell[2])};
    for (const Point& p : hull) {
      const Vec off = frame_.to_index(p) - corner - from;
      const double height =
          bounds.affine_at({share(off.x, to.x - from.x), share(off.y, to.y - from.y), share(off.z, to.z - from.z)});
      least = std::min(least, height - bounds.bent());
      most = std::max(most, height + bounds.bent());
    }
    if (least > 0) return Side::inside;
    return most <= 0 ? Side::outside : Side::unknown;
  }
  static double share(double off, double width) { return width > 0 ? off / width : 0.5; }

  const Field& field_;
  const Frame& frame_;
};

}  // namespace scantet
