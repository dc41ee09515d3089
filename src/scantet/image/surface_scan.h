// Points of the level set on grid edges and on finer lines parallel to them.
#pragma once

#include <array>

#include "scantet/domain/domain.h"
#include "scantet/image/sign_pyramid.h"
#include "scantet/image/trilinear_cell.h"

namespace scantet {

/// Every root of the field on the lines parallel to the axes that cut each cell into divisions[0] × divisions[1] ×
/// divisions[2] boxes (1, 1, 1: the grid edges themselves), in world mm, by block, then cell, then line.
/// On such a line the field is linear within a cell, so there is at most one root and it is exact. A line on faces
/// belongs to the cell that has it on its lower faces (half-open cells): no root comes twice.
template <class Voxel>
class SurfaceScan {
 public:
  SurfaceScan(const PaddedGrid<Voxel>& grid, const SignPyramid& pyramid, const Frame& frame,
              const std::array<int, 3>& divisions, const PointSink& sink)
      : grid_(grid), pyramid_(pyramid), frame_(frame), divisions_(divisions), sink_(sink) {}

  void run() const {
    const std::array<int, 3>& blocks = pyramid_.block_counts();
    for (int z = 0; z < blocks[2]; ++z) {
      for (int y = 0; y < blocks[1]; ++y) {
        for (int x = 0; x < blocks[0]; ++x) {
          const CellIndex first{(x << kShift) - 1, (y << kShift) - 1, (z << kShift) - 1};
          if (pyramid_.fine(first) == BlockSign::mixed) scan_block(first);
        }
      }
    }
  }

 private:
  static constexpr int kShift = SignPyramid::kFineShift;

  void scan_block(const CellIndex& first) const {
    CellIndex end;
    for (int axis = 0; axis < 3; ++axis) end[axis] = std::min(first[axis] + (1 << kShift), grid_.size[axis]);
    for (int k = first[2]; k < end[2]; ++k) {
      for (int j = first[1]; j < end[1]; ++j) {
        for (int i = first[0]; i < end[0]; ++i) {
          const CellHeights heights = grid_.corners(i, j, k);
          if (!has_both_signs(heights)) continue;
          for (int axis = 0; axis < 3; ++axis) scan_lines({i, j, k}, heights, axis);
        }
      }
    }
  }

  void scan_lines(const CellIndex& cell, const CellHeights& heights, int axis) const {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (int b = 0; b < divisions_[v]; ++b) {
      for (int a = 0; a < divisions_[u]; ++a) {
        Vec low;
        low[u] = static_cast<double>(a) / divisions_[u];
        low[v] = static_cast<double>(b) / divisions_[v];
        Vec high = low;
        high[axis] = 1;
        const double from = trilinear(heights, low);
        const double to = trilinear(heights, high);
        if ((from > 0) == (to > 0)) continue;
        low[axis] = from / (from - to);
        sink_(frame_.to_world(Vec{double(cell[0]), double(cell[1]), double(cell[2])} + low));
      }
    }
  }

  const PaddedGrid<Voxel>& grid_;
  const SignPyramid& pyramid_;
  const Frame& frame_;
  std::array<int, 3> divisions_;
  const PointSink& sink_;
};

}  // namespace scantet
