// Neighbouring blocks share nodes, so blocks that touch and are not mixed hold the same label: a row of them needs no
// comparison of labels.
#include "scantet/labels/label_nodes.h"

#include <algorithm>

#include "scantet/base/parallel.h"

namespace scantet {

LabelNodes::LabelNodes(const std::array<int, 3>& size, std::size_t ranks)
    : size_(size), row_(static_cast<std::size_t>(size[0]) + 2), layer_(row_ * (static_cast<std::size_t>(size[1]) + 2)) {
  const std::size_t nodes = layer_ * (static_cast<std::size_t>(size[2]) + 2);
  constexpr std::size_t kMostNarrow = 256;
  if (ranks <= kMostNarrow) {
    narrow_.assign(nodes, 0);
  } else {
    wide_.assign(nodes, 0);
  }
}

void LabelNodes::set_row(int j, int k, const LabelRank* ranks) {
  const std::size_t first = position(0, j, k);
  if (narrow_.empty()) {
    std::copy_n(ranks, size_[0], wide_.begin() + static_cast<std::ptrdiff_t>(first));
    return;
  }
  for (int i = 0; i < size_[0]; ++i) narrow_[first + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(ranks[i]);
}

/// Small blocks beyond the grid are not mixed.
template <class Rank>
std::uint64_t LabelNodes::mixed_in_block(const std::vector<Rank>& ranks, int x, int y, int z) const {
  const std::array<int, 3> first{x << kFineShift, y << kFineShift, z << kFineShift};  // node, counted from the padding
  const auto uniform = [&](int bx, int by, int bz) {
    const std::array<int, 3> low{first[0] + 2 * bx, first[1] + 2 * by, first[2] + 2 * bz};
    const std::array<int, 3> high{std::min(low[0] + 2, size_[0] + 1), std::min(low[1] + 2, size_[1] + 1),
                                  std::min(low[2] + 2, size_[2] + 1)};
    if (low[0] > high[0] || low[1] > high[1] || low[2] > high[2]) return true;
    const Rank rank = ranks[position(low[0] - 1, low[1] - 1, low[2] - 1)];
    for (int k = low[2]; k <= high[2]; ++k) {
      for (int j = low[1]; j <= high[1]; ++j) {
        const Rank* node = &ranks[position(low[0] - 1, j - 1, k - 1)];
        for (int i = low[0]; i <= high[0]; ++i, ++node) {
          if (*node != rank) return false;
        }
      }
    }
    return true;
  };
  std::uint64_t mixed = 0;
  for (int bit = 0; bit < 64; ++bit) {
    if (!uniform(bit & 3, bit >> 2 & 3, bit >> 4)) mixed |= std::uint64_t{1} << bit;
  }
  return mixed;
}

void LabelNodes::find_blocks() {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    fine_counts_[axis] = (size_[axis] >> kFineShift) + 1;
    coarse_counts_[axis] = (size_[axis] >> kCoarseShift) + 1;
  }
  const auto rows = static_cast<std::size_t>(fine_counts_[1]) * static_cast<std::size_t>(fine_counts_[2]);
  mixed_.assign(rows * static_cast<std::size_t>(fine_counts_[0]), 0);
  parallel_for(rows, 1, [&](std::size_t row, std::size_t) {
    const int y = static_cast<int>(row) % fine_counts_[1];
    const int z = static_cast<int>(row) / fine_counts_[1];
    for (int x = 0; x < fine_counts_[0]; ++x) {
      mixed_[row * static_cast<std::size_t>(fine_counts_[0]) + static_cast<std::size_t>(x)] =
          narrow_.empty() ? mixed_in_block(wide_, x, y, z) : mixed_in_block(narrow_, x, y, z);
    }
  });
  coarse_mixed_.assign(static_cast<std::size_t>(coarse_counts_[0]) * static_cast<std::size_t>(coarse_counts_[1]) *
                           static_cast<std::size_t>(coarse_counts_[2]),
                       0);
  for (int z = 0; z < fine_counts_[2]; ++z) {
    for (int y = 0; y < fine_counts_[1]; ++y) {
      for (int x = 0; x < fine_counts_[0]; ++x) {
        const CellIndex first{(x << kFineShift) - 1, (y << kFineShift) - 1, (z << kFineShift) - 1};
        if (fine_is_mixed(first)) coarse_mixed_[coarse_position(first)] = 1;
      }
    }
  }
}

bool LabelNodes::mixed_between(const CellIndex& a, const CellIndex& b) const {
  const auto block_at = [this](int x, int y, int z) {
    const auto at = (static_cast<std::size_t>(z) * fine_counts_[1] + static_cast<std::size_t>(y)) * fine_counts_[0] +
                    static_cast<std::size_t>(x);
    return BlockSigns{mixed_[at], 0};
  };
  return sign_between(a, b, block_at) == BlockSign::mixed;
}

}  // namespace scantet
