// Points of the level set on grid edges and on finer lines parallel to them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/frame.h"
#include "scantet/base/parallel.h"
#include "scantet/domain/domain.h"
#include "scantet/field/block_signs.h"
#include "scantet/field/shared_cells.h"

namespace SCANTET_API scantet {

/// Every root of the field on the lines parallel to the axes that cut each cell into divisions[0] × divisions[1] ×
/// divisions[2] boxes (1, 1, 1: the grid edges themselves), in world mm, by block, then cell, then line. On such a line
/// the field is linear within a cell, so there is at most one root and it is exact. A line on faces belongs to the cell
/// that has it on its lower faces (half-open cells), so no root comes twice. Field: as for TrilinearDomain.
template <class Field>
class SurfaceScan {
 public:
  /// field, frame: outlive the scan. divisions: along each axis, each ≥ 1.
  SurfaceScan(const Field& field, const Frame& frame, const std::array<int, 3>& divisions)
      : field_(field), frame_(frame) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int n = 0; n < divisions[axis]; ++n) {
        fractions_[axis].push_back(static_cast<double>(n) / divisions[axis]);
      }
    }
  }

  /// Scans rows of blocks side by side, a batch at a time, and meanwhile feeds the last batch to the sink, in order:
  /// maybe from another thread than the caller's, but never from two at once. What the sink throws is thrown here. The
  /// points and their order do not depend on the number of threads.
  void run(const PointSink& sink) const {
    constexpr std::size_t kBatch = 32;
    const std::array<int, 3>& blocks = field_.block_counts();
    const std::size_t rows = static_cast<std::size_t>(blocks[1]) * blocks[2];
    std::array<std::vector<Point>, kBatch> found;
    std::array<std::vector<Point>, kBatch> last;
    for (std::size_t begin = 0; begin < rows + kBatch; begin += kBatch) {
      const std::size_t count = std::min(kBatch, rows - std::min(rows, begin));
      found.swap(last);
      parallel_for(1 + count, 1, [&](std::size_t job, std::size_t) {
        if (job == 0) return feed(last, sink);
        std::vector<Point>& points = found[job - 1];
        const std::size_t row = begin + job - 1;
        scan_row(static_cast<int>(row % blocks[1]), static_cast<int>(row / blocks[1]), points);
      });
    }
  }

 private:
  /// Heights at the ends of two edges of a cell that face each other.
  struct Edges {
    std::array<double, 2> low;
    std::array<double, 2> high;
  };

  /// Keeps the memory of rows that are not long.
  static void feed(std::span<std::vector<Point>> rows, const PointSink& sink) {
    constexpr std::size_t kLong = std::size_t{1} << 16;
    for (std::vector<Point>& points : rows) {
      for (const Point& point : points) sink(point);
      points.clear();
      if (points.capacity() > kLong) points.shrink_to_fit();
    }
  }

  void scan_row(int y, int z, std::vector<Point>& out) const {
    std::vector<Edges> scratch;
    constexpr int kBlocks = 1 << (kCoarseShift - kFineShift);
    const auto first_cell = [](int block) { return (block << kFineShift) - 1; };
    for (int x = 0; x < field_.block_counts()[0]; ++x) {
      const CellIndex first{first_cell(x), first_cell(y), first_cell(z)};
      if (field_.fine(first) == BlockSign::mixed) {
        scan_block(first, scratch, out);
      } else if (x % kBlocks == 0 && field_.coarse(first) != BlockSign::mixed) {
        x += kBlocks - 1;
      }
    }
  }

  void scan_block(const CellIndex& first, std::vector<Edges>& scratch, std::vector<Point>& out) const {
    CellIndex end;
    for (int axis = 0; axis < 3; ++axis) end[axis] = std::min(first[axis] + (1 << kFineShift), field_.size()[axis]);
    for (int k = first[2]; k < end[2]; ++k) {
      for (int j = first[1]; j < end[1]; ++j) {
        for (int i = first[0]; i < end[0]; ++i) {
          if (field_.small({i, j, k}) != BlockSign::mixed) continue;
          if (const SharedCell* shared = shared_cell(field_, {i, j, k})) {
            const auto parts = [&](const Vec& above, const Vec& below) {
              return shared->inside(above, true) && !shared->inside(below, false);
            };
            scan_cell({i, j, k}, shared->heights, parts, scratch, out);
            continue;
          }
          const CellHeights heights = field_.corners(i, j, k);
          if (has_both_signs(heights)) {
            scan_cell(
                {i, j, k}, heights, [](const Vec&, const Vec&) { return true; }, scratch, out);
          }
        }
      }
    }
  }

  /// parts(u, v): whether u, above the level, is inside what is kept, and v, not above it, is not; in the cell's own
  /// coordinates.
  template <class Parts>
  void scan_cell(const CellIndex& cell, const CellHeights& heights, const Parts& parts, std::vector<Edges>& scratch,
                 std::vector<Point>& out) const {
    scan_lines<0>(cell, heights, parts, scratch, out);
    scan_lines<1>(cell, heights, parts, scratch, out);
    scan_lines<2>(cell, heights, parts, scratch, out);
  }

  /// Takes the lines along the axis: their ends lie on the cell's low and high face across it. There the field is mixed
  /// along x before y before z, as trilinear() does, so that the roots on a face are the same from both of its sides.
  template <int kAxis, class Parts>
  void scan_lines(const CellIndex& cell, const CellHeights& heights, const Parts& parts, std::vector<Edges>& scratch,
                  std::vector<Point>& out) const {
    constexpr int kU = (kAxis + 1) % 3;
    constexpr int kV = (kAxis + 2) % 3;
    constexpr int kFirst = std::min(kU, kV);
    constexpr int kSecond = std::max(kU, kV);
    constexpr auto kCorner = [](int high, int first, int second) {
      return high << kAxis | first << kFirst | second << kSecond;
    };
    const auto mixed = [&](int high, int second, double t) {
      return mix(heights[kCorner(high, 0, second)], heights[kCorner(high, 1, second)], t);
    };
    scratch.clear();
    for (const double t : fractions_[kFirst]) {
      scratch.push_back({{mixed(0, 0, t), mixed(0, 1, t)}, {mixed(1, 0, t), mixed(1, 1, t)}});
    }
    const std::size_t us = fractions_[kU].size();
    const std::size_t vs = fractions_[kV].size();
    for (std::size_t v = 0; v < vs; ++v) {
      for (std::size_t u = 0; u < us; ++u) {
        const Edges& edges = scratch[kU == kFirst ? u : v];
        const double t = fractions_[kSecond][kU == kFirst ? v : u];
        const double from = mix(edges.low[0], edges.low[1], t);
        const double to = mix(edges.high[0], edges.high[1], t);
        if ((from > 0) == (to > 0)) continue;
        Vec local;
        local[kU] = fractions_[kU][u];
        local[kV] = fractions_[kV][v];
        Vec below = local;
        local[kAxis] = from > 0 ? 0 : 1;
        below[kAxis] = from > 0 ? 1 : 0;
        if (!parts(local, below)) continue;
        local[kAxis] = from / (from - to);
        out.push_back(frame_.to_world(Vec{double(cell[0]), double(cell[1]), double(cell[2])} + local));
      }
    }
  }

  const Field& field_;
  const Frame& frame_;
  std::array<std::vector<double>, 3> fractions_;  // where the lines cut each axis of a cell
};

}  // namespace scantet
