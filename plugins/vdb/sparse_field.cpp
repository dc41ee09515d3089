// Built in three steps. Leaves and tiles are put into pages; coarse blocks of one value share a page. The signs of each
// leaf's nodes are packed into 64 bytes, which is all that the sweeps of the topology and the signs of the cells look
// at. Cells belong to the block of their lowest corner but one, as in SignPyramid, so a block's cells use the last
// nodes of the blocks below it: a coarse block of one value may have mixed cells on its low faces, and gets a page of
// its own then.
#include "sparse_field.h"

#include <algorithm>
#include <optional>

#include "scantet/base/parallel.h"

namespace vdb {

using scantet::BlockSign;
using scantet::BlockSigns;
using scantet::HeightGrid;

template <class Value>
SparseField<Value>::SparseField(const SparseValues<Value>& values, const scantet::LevelSetSettings& settings,
                                const scantet::Progress& progress)
    : owner_(values.owner),
      size_(values.size),
      level_(settings.level),
      sign_(settings.inside == scantet::InsideSide::above ? 1 : -1),
      node_signs_{NodeSigns{}, NodeSigns{}} {
  node_signs_[kAllInside].fill(~std::uint64_t{0});
  for (int axis = 0; axis < 3; ++axis) {
    counts_[axis] = (size_[axis] >> kBlockShift) + 1;
    page_counts_[axis] = (size_[axis] >> scantet::kCoarseShift) + 1;
  }
  page_at_.resize(page_place(0, 0, page_counts_[2]));
  add_uniform_page(values.background);
  for (const Tile<Value>& tile : values.tiles) put_tile(tile);
  put_leaves(values.leaves, progress);
  find_cell_signs(progress);
  if (progress.cancelled()) return;
  pages_.shrink_to_fit();
  find_spans(progress);
}

template <class Value>
typename SparseField<Value>::Block SparseField<Value>::uniform_block(Value value) const {
  const bool inside = height_of(value) > 0;
  return {nullptr, value, inside ? kAllInside : kAllOutside, {0, inside ? ~std::uint64_t{0} : 0}};
}

template <class Value>
std::uint32_t SparseField<Value>::add_uniform_page(Value value) {
  Page page;
  page.blocks.fill(uniform_block(value));
  page.sign = page.blocks[0].cells.whole();
  page.shared = true;
  pages_.push_back(page);
  return static_cast<std::uint32_t>(pages_.size() - 1);
}

/// The page of a coarse block, made its own if it is shared.
template <class Value>
std::uint32_t SparseField<Value>::own_page(std::size_t place) {
  if (pages_[page_at_[place]].shared) {
    const Page copy = pages_[page_at_[place]];
    pages_.push_back(copy);
    pages_.back().shared = false;
    page_at_[place] = static_cast<std::uint32_t>(pages_.size() - 1);
  }
  return page_at_[place];
}

template <class Value>
void SparseField<Value>::put_tile(const Tile<Value>& tile) {
  const Block block = uniform_block(tile.value);
  std::optional<std::uint32_t> uniform;  // a page, once a coarse block is wholly in the tile
  Index last;                            // page
  for (int axis = 0; axis < 3; ++axis) last[axis] = (tile.block[axis] + tile.side - 1) >> kPageShift;
  Index p;
  for (p[2] = tile.block[2] >> kPageShift; p[2] <= last[2]; ++p[2]) {
    for (p[1] = tile.block[1] >> kPageShift; p[1] <= last[1]; ++p[1]) {
      for (p[0] = tile.block[0] >> kPageShift; p[0] <= last[0]; ++p[0]) {
        Index from;
        Index to;
        bool whole = true;
        for (int axis = 0; axis < 3; ++axis) {
          from[axis] = std::max(tile.block[axis], p[axis] << kPageShift);
          to[axis] = std::min(tile.block[axis] + tile.side, (p[axis] + 1) << kPageShift);
          whole = whole && to[axis] - from[axis] == kPageSide;
        }
        const std::size_t place = page_place(p[0], p[1], p[2]);
        if (whole) {
          if (!uniform) uniform = add_uniform_page(tile.value);
          page_at_[place] = *uniform;
        } else {
          fill(pages_[own_page(place)], from, to, block);
        }
      }
    }
  }
}

template <class Value>
void SparseField<Value>::fill(Page& page, const Index& from, const Index& to, const Block& block) {
  for (int z = from[2]; z < to[2]; ++z) {
    for (int y = from[1]; y < to[1]; ++y) {
      for (int x = from[0]; x < to[0]; ++x) page.blocks[place_in_page(x, y, z)] = block;
    }
  }
}

template <class Value>
void SparseField<Value>::put_leaves(const std::vector<Leaf<Value>>& leaves, const scantet::Progress& progress) {
  constexpr std::size_t kGrain = 1024;
  const std::size_t first = node_signs_.size();
  node_signs_.resize(first + leaves.size());
  scantet::parallel_for(leaves.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    if (progress.cancelled()) return;
    for (std::size_t n = begin; n < end; ++n) {
      NodeSigns& signs = node_signs_[first + n];
      for (int at = 0; at < kBlockSide * kBlockSide * kBlockSide; ++at) {
        const int x = at >> 2 * kBlockShift;
        const int y = at >> kBlockShift & (kBlockSide - 1);
        const int z = at & (kBlockSide - 1);
        signs[z] |= std::uint64_t{height_of(leaves[n].values[at]) > 0} << (8 * y + x);
      }
    }
  });
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    const auto& [x, y, z] = leaves[n].block;
    Page& page = pages_[own_page(page_place(x >> kPageShift, y >> kPageShift, z >> kPageShift))];
    Block& block = page.blocks[place_in_page(x, y, z)];
    block.values = leaves[n].values;
    block.nodes = static_cast<std::uint32_t>(first + n);
    for (const std::uint32_t uniform : {kAllOutside, kAllInside}) {
      if (node_signs_[first + n] == node_signs_[uniform]) block.nodes = uniform;
    }
  }
}

/// Block (x, y, z), which may be one before the first.
template <class Value>
const typename SparseField<Value>::NodeSigns& SparseField<Value>::nodes_of(int x, int y, int z) const {
  return node_signs_[x < 0 || y < 0 || z < 0 ? kAllOutside : block(x, y, z).nodes];
}

template <class Value>
BlockSigns SparseField<Value>::cell_signs(int x, int y, int z) const {
  constexpr int kNodes = kBlockSide + 1;  // the last ones of the blocks below come first
  std::array<const NodeSigns*, 8> around;
  for (int n = 0; n < 8; ++n) around[n] = &nodes_of(x - 1 + (n & 1), y - 1 + (n >> 1 & 1), z - 1 + (n >> 2));
  const bool alike = std::all_of(around.begin(), around.end(), [&](const auto* one) { return one == around[0]; });
  if (alike && around[0] == &node_signs_[kAllOutside]) return {0, 0};
  if (alike && around[0] == &node_signs_[kAllInside]) return {0, ~std::uint64_t{0}};
  std::array<std::array<unsigned, kNodes>, kNodes> rows;  // [z][y]: nine bits along x
  for (int k = 0; k < kNodes; ++k) {
    for (int j = 0; j < kNodes; ++j) {
      const int n = (j > 0 ? 2 : 0) | (k > 0 ? 4 : 0);
      const int word = (k + kBlockSide - 1) % kBlockSide;
      const int shift = 8 * ((j + kBlockSide - 1) % kBlockSide);
      rows[k][j] = ((*around[n])[word] >> shift >> 7 & 1) | ((*around[n | 1])[word] >> shift & 0xFF) << 1;
    }
  }
  BlockSigns signs;
  for (int part = 0; part < 16; ++part) {
    unsigned some = 0;
    unsigned all = ~0U;
    for (int n = 0; n < 9; ++n) {
      const unsigned row = rows[2 * (part >> 2) + n / 3][2 * (part & 3) + n % 3];
      some |= row;
      all &= row;
    }
    for (int i = 0; i < 4; ++i) {
      const std::uint64_t bit = std::uint64_t{1} << (4 * part + i);
      const bool full = (all >> 2 * i & 7) == 7;
      if (full) signs.inside |= bit;
      if (!full && (some >> 2 * i & 7) != 0) signs.mixed |= bit;
    }
  }
  return signs;
}

/// Whether a coarse block that shares a page has neighbours below that are not all of its sign.
template <class Value>
bool SparseField<Value>::may_be_mixed(int px, int py, int pz) const {
  const BlockSign sign = pages_[page_at_[page_place(px, py, pz)]].sign;
  for (int n = 0; n < 7; ++n) {
    const Index at{px - 1 + (n & 1), py - 1 + (n >> 1 & 1), pz - 1 + (n >> 2)};
    const bool padding = at[0] < 0 || at[1] < 0 || at[2] < 0;
    const Page& below = pages_[padding ? 0 : page_at_[page_place(at[0], at[1], at[2])]];
    if (!below.shared || below.sign != sign) return true;
  }
  return false;
}

template <class Value>
void SparseField<Value>::find_cell_signs(const scantet::Progress& progress) {
  const auto position = [&](std::size_t place) {
    const std::size_t row = place / page_counts_[0];
    return Index{static_cast<int>(place % page_counts_[0]), static_cast<int>(row % page_counts_[1]),
                 static_cast<int>(row / page_counts_[1])};
  };
  std::vector<std::size_t> own;
  for (std::size_t place = 0; place < page_at_.size(); ++place) {
    const auto [px, py, pz] = position(place);
    if (!pages_[page_at_[place]].shared || may_be_mixed(px, py, pz)) own.push_back(place);
  }
  const auto signs_of = [&](std::size_t place, auto visit) {
    const auto [px, py, pz] = position(place);
    for (int n = 0; n < kPageSide * kPageSide * kPageSide; ++n) {
      visit(n,
            cell_signs(px << kPageShift | (n & (kPageSide - 1)), py << kPageShift | (n >> kPageShift & (kPageSide - 1)),
                       pz << kPageShift | n >> 2 * kPageShift));
    }
  };
  std::vector<std::array<BlockSigns, kPageBlocks>> found(own.size());
  scantet::parallel_for(own.size(), 16, [&](std::size_t begin, std::size_t end) {
    if (progress.cancelled()) return;
    for (std::size_t n = begin; n < end; ++n) {
      signs_of(own[n], [&](int at, const BlockSigns& signs) { found[n][at] = signs; });
    }
  });
  for (std::size_t n = 0; n < own.size(); ++n) {
    const BlockSign first = found[n][0].whole();
    const bool uniform =
        std::all_of(found[n].begin(), found[n].end(), [&](const BlockSigns& signs) { return signs.whole() == first; });
    if (uniform && first != BlockSign::mixed && pages_[page_at_[own[n]]].shared) continue;
    Page& page = pages_[own_page(own[n])];
    page.sign = uniform ? first : BlockSign::mixed;
    for (std::size_t at = 0; at < page.blocks.size(); ++at) page.blocks[at].cells = found[n][at];
  }
}

template <class Value>
bool SparseField<Value>::has_zero(const Block& block) const {
  if (block.values == nullptr) return height_of(block.value) == 0;
  constexpr int kNodes = kBlockSide * kBlockSide * kBlockSide;
  return std::any_of(block.values, block.values + kNodes, [&](Value value) { return height_of(value) == 0; });
}

template <class Value>
void SparseField<Value>::find_spans(const scantet::Progress& progress) {
  spans_.resize(static_cast<std::size_t>(counts_[1]) * counts_[2]);
  zero_spans_.resize(spans_.size());
  const auto add = [](int x, Span& span) {
    if (span.end == 0) span.begin = x;
    span.end = x + 1;
  };
  const bool is_background_zero = outside_height() == 0;
  scantet::parallel_for(counts_[2], 1, [&](std::size_t z, std::size_t) {
    if (progress.cancelled()) return;
    for (int y = 0; y < counts_[1]; ++y) {
      const std::size_t row = z * counts_[1] + y;
      for (int x = 0; x < counts_[0]; ++x) {
        const std::size_t place = page_place(x >> kPageShift, y >> kPageShift, static_cast<int>(z) >> kPageShift);
        if (page_at_[place] == 0 && !is_background_zero) {
          x |= kPageSide - 1;
          continue;
        }
        const Block& b = block(x, y, static_cast<int>(z));
        if (b.nodes != kAllOutside) add(x, spans_[row]);
        if (has_zero(b)) add(x, zero_spans_[row]);
      }
    }
  });
}

template <class Value>
bool SparseField<Value>::row_signs(int j, int k, std::uint64_t* words) const {
  if (j < 0 || j >= size_[1] || k < 0 || k >= size_[2]) return false;
  const Span span = spans_[static_cast<std::size_t>(k >> kBlockShift) * counts_[1] + (j >> kBlockShift)];
  if (span.begin == span.end) return false;
  std::fill_n(words, (size_[0] + 2 + 63) / 64, 0);
  bool any = false;
  for (int x = span.begin; x < span.end; ++x) {
    const NodeSigns& signs = node_signs_[block(x, j >> kBlockShift, k >> kBlockShift).nodes];
    const std::uint64_t byte = signs[k & (kBlockSide - 1)] >> 8 * (j & (kBlockSide - 1)) & 0xFF;
    if (byte == 0) continue;
    any = true;
    const int bit = kBlockSide * x + 1;
    words[bit / 64] |= byte << bit % 64;
    if (bit % 64 > 64 - kBlockSide && byte >> (64 - bit % 64) != 0) words[bit / 64 + 1] |= byte >> (64 - bit % 64);
  }
  return any;
}

template <class Value>
bool SparseField<Value>::row_zeros(int j, int k, std::uint64_t* words) const {
  if (j < 0 || j >= size_[1] || k < 0 || k >= size_[2]) return false;
  const Span span = zero_spans_[static_cast<std::size_t>(k >> kBlockShift) * counts_[1] + (j >> kBlockShift)];
  bool any = false;
  const auto mark = [&](int i) {
    if (!any) std::fill_n(words, (size_[0] + 2 + 63) / 64, 0);
    any = true;
    words[(i + 1) / 64] |= std::uint64_t{1} << (i + 1) % 64;
  };
  const int end = std::min(size_[0], span.end << kBlockShift);
  for (int i = span.begin << kBlockShift; i < end;) {
    const int stop = std::min(end, (i | (kBlockSide - 1)) + 1);
    const Block& b = block(i >> kBlockShift, j >> kBlockShift, k >> kBlockShift);
    const bool may_be = b.values != nullptr || height_of(b.value) == 0;
    for (; may_be && i < stop; ++i) {
      if (b.values == nullptr || height_of(b.values[offset(i, j, k)]) == 0) mark(i);
    }
    i = stop;
  }
  return any;
}

template <class Value>
HeightGrid::Extreme SparseField<Value>::extreme(int begin, int end, int j, int k, bool highest) const {
  const bool largest = highest == (sign_ > 0);
  int found = begin;
  Value best{};
  for (int i = begin; i < end;) {
    const Block& b = block(i >> kBlockShift, j >> kBlockShift, k >> kBlockShift);
    const int stop = std::min(end, ((i >> kBlockShift) + 1) << kBlockShift);
    for (; i < stop; ++i) {
      const Value value = b.values == nullptr ? b.value : b.values[offset(i, j, k)];
      if (i == begin || (largest ? value > best : value < best)) {
        best = value;
        found = i;
      }
      if (b.values == nullptr) i = stop - 1;  // the rest is equal
    }
  }
  return {found, height_of(best)};
}

template class SparseField<float>;
template class SparseField<double>;
template class SparseField<std::int32_t>;
template class SparseField<std::int64_t>;

}  // namespace vdb
