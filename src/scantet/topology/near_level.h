// Finds where a grid of heights is near the level, 64 nodes at a time.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "scantet/field/run_sweep.h"

namespace scantet {

/// Word `word` of a row of bits moved by `by` places: bit p of it is bit p + by of the row. |by| < 64. beyond: the word
/// before the first and after the last.
inline std::uint64_t moved_word(std::span<const std::uint64_t> row, std::size_t word, int by, std::uint64_t beyond) {
  if (by == 0) return row[word];
  if (by > 0) return row[word] >> by | (word + 1 < row.size() ? row[word + 1] : beyond) << (64 - by);
  return row[word] << -by | (word > 0 ? row[word - 1] : beyond) >> (64 + by);
}

/// Of each row of one layer, what is known of the rows j - before … j + after, bit by bit.
struct RowsAround {
  std::vector<std::uint64_t> some;  ///< whether a node is inside
  std::vector<std::uint64_t> all;   ///< whether all are

  void set(const SignLayer& layer, int before, int after) {
    some.assign(layer.signs.size(), 0);
    all.assign(layer.signs.size(), ~std::uint64_t{0});
    const auto words = static_cast<std::size_t>(layer.words);
    for (int row = 0; row < layer.rows; ++row) {
      const std::size_t at = static_cast<std::size_t>(row) * words;
      for (int y = std::max(0, row - before); y <= std::min(layer.rows - 1, row + after); ++y) {
        const std::uint64_t* signs = layer.row_signs(y);
        for (std::size_t w = 0; w < words; ++w) {
          some[at + w] |= signs[w];
          all[at + w] &= signs[w];
        }
      }
    }
  }
};

/// Calls visit(i, j, k) for each place i, j = -1 … size - 1, k = begin … end - 1, where some of the nodes
/// i - before … i + after, j - before … j + after, k - before … k + after are inside and some are not; nodes beyond the
/// padding do not count. In the order of k, then j, then i. begin: at least -1.
template <class Visit>
void visit_near_level(const HeightGrid& heights, int before, int after, int begin, int end, Visit visit) {
  const int depth = before + after + 1;
  const auto& size = heights.size();
  SignLayer signs(heights);
  std::vector<RowsAround> layers(static_cast<std::size_t>(depth));
  const auto layer = [&](int k) -> RowsAround& { return layers[static_cast<std::size_t>((k + before + 1) % depth)]; };
  const auto read = [&](int k) {
    if (k < -1 || k > size[2]) return;
    for (int row = 0; row < signs.rows; ++row) signs.read_row(heights, row, k);
    layer(k).set(signs, before, after);
  };
  const auto words = static_cast<std::size_t>(heights.row_words());
  const int last_bits = (size[0] + 2) % 64;  // of a row's last word; 0: all
  const std::uint64_t beyond_row = last_bits == 0 ? 0 : ~std::uint64_t{0} << last_bits;
  std::vector<std::uint64_t> some(words);
  std::vector<std::uint64_t> all(words);
  for (int k = begin - before; k < begin + after; ++k) read(k);
  for (int k = begin; k < end; ++k) {
    read(k + after);
    for (int j = -1; j < size[1]; ++j) {
      std::fill(some.begin(), some.end(), 0);
      std::fill(all.begin(), all.end(), ~std::uint64_t{0});
      const std::size_t row = static_cast<std::size_t>(j + 1) * words;
      for (int z = std::max(-1, k - before); z <= std::min(size[2], k + after); ++z) {
        const RowsAround& around = layer(z);
        for (std::size_t w = 0; w < words; ++w) {
          some[w] |= around.some[row + w];
          all[w] &= around.all[row + w];
        }
      }
      all.back() |= beyond_row;
      for (std::size_t w = 0; w < words; ++w) {
        std::uint64_t inside = 0;
        std::uint64_t only_inside = ~std::uint64_t{0};
        for (int d = -before; d <= after; ++d) {
          inside |= moved_word(some, w, d, 0);
          only_inside &= moved_word(all, w, d, ~std::uint64_t{0});
        }
        for (std::uint64_t near = inside & ~only_inside; near != 0; near &= near - 1) {
          const int i = static_cast<int>(64 * w) + std::countr_zero(near) - 1;
          if (i < size[0]) visit(i, j, k);
        }
      }
    }
  }
}

}  // namespace scantet
