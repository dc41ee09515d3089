// A label map's fields, as the verifier is told them.
#pragma once

#include <array>
#include <cstddef>

#include "scantet/base/api.h"
#include "scantet/base/frame.h"
#include "scantet/base/stratum.h"

namespace SCANTET_API scantet {

/// The fields of one cell: trilinear, from the values at its corners (bit 0 of the position is x, bit 1 y, bit 2 z).
struct LabelCellValues {
  std::size_t count = 0;                          ///< regions at its corners, 1 to 8
  std::array<Region, 8> regions{};                ///< the first `count`, ascending
  std::array<std::array<double, 8>, 8> values{};  ///< of each region's field, at the eight corners
};

/// The voxels of a label map and the fields whose largest decides, within each cell, which region a point is in. Nodes
/// have the indices of voxels, and one layer of kOutside around them; cells are from -1 to size - 1. Answers on several
/// threads.
class LabelSource {
 public:
  virtual ~LabelSource() = default;
  /// Voxels along each axis.
  virtual const std::array<int, 3>& size() const = 0;
  /// Voxel index to world, mm.
  virtual const Frame& frame() const = 0;
  /// What the voxel says; kOutside beyond the image, where it is asked, too.
  virtual Region region_of(int i, int j, int k) const = 0;
  /// Regions at the corners of a cell, of which (i, j, k) is the first, and their values; `out` is overwritten. Asked
  /// only of cells whose corners are in several regions. A node whose region's field is not the largest there is a
  /// finding of verify_labels(), as is a face on which a region that none of its corners has may have the largest.
  virtual void cell(int i, int j, int k, LabelCellValues& out) const = 0;
};

}  // namespace scantet
