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

/// Heights of a scan's nodes above the level; the indices are those of PaddedGrid, -1 … size along each axis.
/// Immutable.
class HeightGrid {
 public:
  virtual ~HeightGrid() = default;

  /// Nodes along each axis, without the padding.
  const std::array<int, 3>& size() const { return size_; }
  /// Of a node.
  virtual double height(int i, int j, int k) const = 0;
  /// Of the corners of a cell.
  virtual CellHeights corners(int i, int j, int k) const = 0;
  /// The heights of the field as it was read, which differ from corners() where nodes have been turned outside since.
  virtual CellHeights field_corners(int i, int j, int k) const { return corners(i, j, k); }

  /// Which nodes of a row are inside: node i is bit i + 1 (so that the padding has its bits, always clear).
  /// words: room for row_words() of them. Return: whether any is inside; if not, the words may be left as they are.
  virtual bool row_signs(int j, int k, std::uint64_t* words) const = 0;
  /// Which nodes are at the level itself, in words as those of row_signs(); nodes of the padding never are.
  virtual bool row_zeros(int j, int k, std::uint64_t* words) const = 0;
  /// Words for one bit for each node of a row, padding included.
  int row_words() const { return (size_[0] + 2 + 63) / 64; }

  /// A node of a row, and its height.
  struct Extreme {
    int i;
    double height;
  };
  /// The highest (or lowest) of nodes begin … end - 1 of a row of the image; the first of several.
  virtual Extreme extreme(int begin, int end, int j, int k, bool highest) const = 0;

 protected:
  /// size: nodes along each axis, without the padding.
  explicit HeightGrid(const std::array<int, 3>& size) : size_(size) {}

 private:
  std::array<int, 3> size_;
};

/// The grid keeps the scan's voxels alive.
std::unique_ptr<HeightGrid> make_height_grid(const Scan& scan, const LevelSetSettings& settings);

}  // namespace scantet
