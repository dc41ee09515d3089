// The padded grid of heights without its voxel type.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "scantet/base/api.h"
#include "scantet/field/level_settings.h"
#include "scantet/field/scan.h"
#include "scantet/field/trilinear_cell.h"

namespace SCANTET_API scantet {

/// Heights of a scan's nodes above the level, in the unit of the values; with InsideSide::below, below it. A node is
/// inside if its height is above zero. Nodes have the indices of the voxels, and -1 and size along each axis in the
/// padding, whose heights are not above zero; cell (i, j, k) has node (i, j, k) for its low corner. Immutable, so const
/// methods may be called from many threads.
class HeightGrid {
 public:
  virtual ~HeightGrid() = default;

  /// Nodes along each axis, without the padding.
  const std::array<int, 3>& size() const { return size_; }
  /// The height of a node.
  virtual double height(int i, int j, int k) const = 0;
  /// The heights at the corners of a cell.
  virtual CellHeights corners(int i, int j, int k) const = 0;
  /// The heights of the field as it was read, which differ from corners() where nodes have been turned outside or
  /// inside since. Default: corners().
  virtual CellHeights field_corners(int i, int j, int k) const { return corners(i, j, k); }

  /// Which nodes of a row are inside: node i is bit i + 1 (so that the padding has its bits, always clear).
  /// words: room for row_words() of them. Return: whether any is inside; if not, the words may be left as they are.
  virtual bool row_signs(int j, int k, std::uint64_t* words) const = 0;
  /// Which nodes are at the level itself, in words as those of row_signs(); nodes of the padding never are. Return:
  /// whether any is; if not, the words may be left as they are.
  virtual bool row_zeros(int j, int k, std::uint64_t* words) const = 0;
  /// How many words take one bit for each node of a row, padding included.
  int row_words() const { return (size_[0] + 2 + 63) / 64; }

  /// A node of a row, and its height.
  struct Extreme {
    int i;
    double height;
  };
  /// The highest (or lowest) of nodes begin … end - 1 of a row of the image; the first of several. Pre: 0 ≤ begin < end
  /// ≤ size()[0]; j and k are not in the padding.
  virtual Extreme extreme(int begin, int end, int j, int k, bool highest) const = 0;

 protected:
  /// size: nodes along each axis, without the padding.
  explicit HeightGrid(const std::array<int, 3>& size) : size_(size) {}

 private:
  std::array<int, 3> size_;
};

/// The heights of a scan; never null. The grid keeps Scan::owner, and so should keep the voxels alive. settings: as
/// checked_settings() (image/level_set.h) gives them.
std::unique_ptr<HeightGrid> make_height_grid(const Scan& scan, const LevelSetSettings& settings);

}  // namespace scantet
