// The heights of a sparse grid above a level, as a field for scantet's TrilinearDomain.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/field/block_signs.h"
#include "scantet/field/height_grid.h"
#include "scantet/field/trilinear_cell.h"
#include "scantet/image/level_set.h"

namespace vdb {

using Index = std::array<int, 3>;

inline constexpr int kBlockShift = scantet::kFineShift;
inline constexpr int kBlockSide = 1 << kBlockShift;  // nodes of a leaf along each axis, cells of a fine block

/// 8³ nodes, stored elsewhere with z running fastest, then y.
template <class Value>
struct Leaf {
  Index block;  ///< its first node, divided by 8
  const Value* values;
};

/// A cube of equal nodes.
template <class Value>
struct Tile {
  Index block;  ///< as in Leaf
  int side;     ///< blocks along each axis
  Value value;
};

/// What a tree holds: leaves and tiles, disjoint, and the background everywhere else. Indices are ≥ 0.
template <class Value>
struct SparseValues {
  Index size{};  ///< nodes along each axis; beyond is background
  Value background{};
  std::vector<Leaf<Value>> leaves;
  std::vector<Tile<Value>> tiles;
  std::shared_ptr<const void> owner;  ///< keeps the leaves' values alive
};

/// Height is value - level, negated when the inside is below; the background's is ≤ 0. Nodes and cells are numbered as
/// those of PaddedGrid. Nodes are found by two array look-ups: the page of a coarse block, then the block in it. Memory
/// beyond the values: 2 kB (2.5 kB for 8-byte values) for each coarse block of 32³ cells that holds more than one
/// value, 64 bytes a leaf, and four for each coarse block of the box. Immutable.
template <class Value>
class SparseField {
 public:
  /// Nothing may be asked of it once progress.cancelled() became true.
  SparseField(const SparseValues<Value>& values, const scantet::LevelSetSettings& settings,
              const scantet::Progress& progress);

  const Index& size() const { return size_; }
  double outside_height() const { return height_of(pages_[0].blocks[0].value); }
  scantet::BlockSign small(const scantet::CellIndex& cell) const { return block_of_cell(cell).cells.small(cell); }
  scantet::BlockSign fine(const scantet::CellIndex& cell) const { return block_of_cell(cell).cells.whole(); }
  scantet::BlockSign coarse(const scantet::CellIndex& cell) const {
    return page((cell[0] + 1) >> kBlockShift, (cell[1] + 1) >> kBlockShift, (cell[2] + 1) >> kBlockShift).sign;
  }
  scantet::BlockSign between(const scantet::CellIndex& a, const scantet::CellIndex& b) const {
    return scantet::sign_between(
        a, b, [this](int x, int y, int z) -> const scantet::BlockSigns& { return block(x, y, z).cells; });
  }
  const Index& block_counts() const { return counts_; }

  double height(int i, int j, int k) const {
    const auto beyond = [this](int n, int axis) {
      return static_cast<unsigned>(n) >= static_cast<unsigned>(size_[axis]);
    };
    if (beyond(i, 0) || beyond(j, 1) || beyond(k, 2)) return outside_height();
    const Block& b = block(i >> kBlockShift, j >> kBlockShift, k >> kBlockShift);
    return height_of(b.values == nullptr ? b.value : b.values[offset(i, j, k)]);
  }

  scantet::CellHeights corners(int i, int j, int k) const {
    constexpr int kLast = kBlockSide - 1;
    scantet::CellHeights h;
    if ((i & kLast) == kLast || (j & kLast) == kLast || (k & kLast) == kLast) {  // more blocks than one, or padding
      for (int c = 0; c < 8; ++c) h[c] = height(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
      return h;
    }
    const Block& b = block(i >> kBlockShift, j >> kBlockShift, k >> kBlockShift);
    if (b.values == nullptr) {
      h.fill(height_of(b.value));
      return h;
    }
    const Value* v = b.values + offset(i, j, k);
    for (int c = 0; c < 8; ++c) h[c] = height_of(v[offset(c & 1, c >> 1 & 1, c >> 2)]);
    return h;
  }

  /// act(block, mixed) of each fine block with nodes on both sides of the level. mixed: as in BlockSigns, not 0.
  template <class Act>
  void for_each_mixed_block(const Act& act) const;

  /// As HeightGrid's.
  bool row_signs(int j, int k, std::uint64_t* words) const;
  bool row_zeros(int j, int k, std::uint64_t* words) const;
  scantet::HeightGrid::Extreme extreme(int begin, int end, int j, int k, bool highest) const;

 private:
  static constexpr int kPageShift = scantet::kCoarseShift - kBlockShift;
  static constexpr int kPageSide = 1 << kPageShift;  // blocks
  static constexpr std::size_t kPageBlocks = std::size_t{1} << 3 * kPageShift;
  static constexpr std::uint32_t kAllOutside = 0;  // numbers in node_signs_
  static constexpr std::uint32_t kAllInside = 1;

  /// The nodes 8·b … 8·b + 7 along each axis, and the cells of fine block b.
  struct Block {
    const Value* values = nullptr;  // null: all are `value`
    Value value{};
    std::uint32_t nodes = kAllOutside;  // which of the nodes are inside: a number in node_signs_
    scantet::BlockSigns cells;
  };
  struct Page {
    std::array<Block, kPageBlocks> blocks;
    scantet::BlockSign sign = scantet::BlockSign::mixed;  // of the cells of all blocks
    bool shared = false;                                  // by coarse blocks that hold one value
  };
  /// Bit x of byte y of word z: node (x, y, z) is inside.
  using NodeSigns = std::array<std::uint64_t, kBlockSide>;
  struct Span {
    int begin = 0;
    int end = 0;
  };

  static int offset(int i, int j, int k) {
    constexpr int kMask = kBlockSide - 1;
    return (i & kMask) << 2 * kBlockShift | (j & kMask) << kBlockShift | (k & kMask);
  }
  static int place_in_page(int x, int y, int z) {
    constexpr int kMask = kPageSide - 1;
    return (x & kMask) | (y & kMask) << kPageShift | (z & kMask) << 2 * kPageShift;
  }
  double height_of(Value value) const { return sign_ * (static_cast<double>(value) - level_); }
  std::size_t page_place(int px, int py, int pz) const {
    return (static_cast<std::size_t>(pz) * page_counts_[1] + py) * page_counts_[0] + px;
  }
  /// The page of a block.
  const Page& page(int x, int y, int z) const {
    return pages_[page_at_[page_place(x >> kPageShift, y >> kPageShift, z >> kPageShift)]];
  }
  const Block& block(int x, int y, int z) const { return page(x, y, z).blocks[place_in_page(x, y, z)]; }
  const Block& block_of_cell(const scantet::CellIndex& cell) const {
    return block((cell[0] + 1) >> kBlockShift, (cell[1] + 1) >> kBlockShift, (cell[2] + 1) >> kBlockShift);
  }

  Block uniform_block(Value value) const;
  std::uint32_t add_uniform_page(Value value);
  std::uint32_t own_page(std::size_t place);
  void put_tile(const Tile<Value>& tile);
  static void fill(Page& page, const Index& from, const Index& to, const Block& block);
  void put_leaves(const std::vector<Leaf<Value>>& leaves, const scantet::Progress& progress);
  const NodeSigns& nodes_of(int x, int y, int z) const;
  scantet::BlockSigns cell_signs(int x, int y, int z) const;
  bool may_be_mixed(int px, int py, int pz) const;
  void find_cell_signs(const scantet::Progress& progress);
  bool has_zero(const Block& block) const;
  void find_spans(const scantet::Progress& progress);

  std::shared_ptr<const void> owner_;
  Index size_{};
  Index counts_{};       // of blocks
  Index page_counts_{};  // of coarse blocks
  double level_ = 0;
  double sign_ = 1;
  std::vector<std::uint32_t> page_at_;  // of each coarse block, x fastest
  std::vector<Page> pages_;             // the first is the background's
  std::vector<NodeSigns> node_signs_;
  std::vector<Span> spans_;       // of each row of blocks, y fastest: those with a node inside are in begin ≤ x < end
  std::vector<Span> zero_spans_;  // the same of those with a node at the level
};

template <class Value>
template <class Act>
void SparseField<Value>::for_each_mixed_block(const Act& act) const {
  for (std::size_t place = 0; place < page_at_.size(); ++place) {
    const Page& page = pages_[page_at_[place]];
    if (page.sign != scantet::BlockSign::mixed) continue;
    const std::size_t row = place / page_counts_[0];
    const Index first{static_cast<int>(place % page_counts_[0]), static_cast<int>(row % page_counts_[1]),
                      static_cast<int>(row / page_counts_[1])};
    for (int n = 0; n < static_cast<int>(kPageBlocks); ++n) {
      const Index in_page{n & (kPageSide - 1), n >> kPageShift & (kPageSide - 1), n >> 2 * kPageShift};
      Index block;
      for (int axis = 0; axis < 3; ++axis) block[axis] = first[axis] << kPageShift | in_page[axis];
      if (page.blocks[n].cells.mixed != 0) act(block, page.blocks[n].cells.mixed);
    }
  }
}

}  // namespace vdb
