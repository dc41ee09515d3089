// The voxels of a scan as a field for TrilinearDomain: heights and signs.
#pragma once

#include <memory>

#include "scantet/field/padded_grid.h"
#include "scantet/field/sign_pyramid.h"
#include "scantet/field/trilinear_cell.h"

namespace scantet {

/// It keeps the voxels alive. Immutable.
template <class Voxel>
class VoxelField {
 public:
  VoxelField(const Scan& scan, const LevelSetSettings& settings, const Voxel* voxels)
      : owner_(scan.owner), grid_(padded_grid(scan, voxels, settings)), pyramid_(grid_) {}

  const std::array<int, 3>& size() const { return grid_.size; }
  double outside_height() const { return grid_.outside_height; }
  CellHeights corners(int i, int j, int k) const { return grid_.corners(i, j, k); }
  BlockSign small(const CellIndex& cell) const { return pyramid_.small(cell); }
  BlockSign fine(const CellIndex& cell) const { return pyramid_.fine(cell); }
  BlockSign coarse(const CellIndex& cell) const { return pyramid_.coarse(cell); }
  BlockSign between(const CellIndex& a, const CellIndex& b) const { return pyramid_.between(a, b); }
  const std::array<int, 3>& block_counts() const { return pyramid_.block_counts(); }

 private:
  std::shared_ptr<const void> owner_;
  PaddedGrid<Voxel> grid_;
  SignPyramid pyramid_;
};

}  // namespace scantet
