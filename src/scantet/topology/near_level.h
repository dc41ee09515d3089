// Finds where a grid of heights is near the level, 64 nodes at a time.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "scantet/field/run_sweep.h"

namespace scantet {

/// Word `word` of a row of bits moved by `by` places: bit p of it is bit p + by of the row. |by| < 64. beyond: the word
/// before the first and after the last.
inline std::uint64_t moved_word(const std::vector<std::uint64_t>& row, std::size_t word, int by, std::uint64_t beyond) {
  if (by == 0) return row[word];
  if (by > 0) return row[word] >> by | (word + 1 < row.size() ? row[word + 1] : beyond) << (64 - by);
  return row[word] << -by | (word > 0 ? row[word - 1] : beyond) >> (64 + by);
}

/// Calls visit(near, inside, word, j, k) for words of the rows -1 … size - 1 of the layers begin … end - 1, from k = -1
/// on, in the order of k, then j, then word. In both a node i has bit i + 1 of the row, as in HeightGrid::row_signs().
/// near: set where some of the nodes i - before … i + after, j - before … j + after, k - before … k + after are inside
/// and some are not; nodes beyond the padding do not count. Words without such a bit are left out. inside: which nodes
/// are.
template <class Visit>
void visit_words_near_level(const HeightGrid& heights, int before, int after, int begin, int end, Visit visit) {
  const int depth = before + after + 1;
  const auto& size = heights.size();
  std::vector<SignLayer> layers(static_cast<std::size_t>(depth), SignLayer(heights));
  const auto layer = [&](int k) -> SignLayer& { return layers[static_cast<std::size_t>((k + before + 1) % depth)]; };
  const auto is_layer = [&](int k) { return k >= -1 && k <= size[2]; };
  const auto read = [&](int k) {
    if (!is_layer(k)) return;
    for (int row = 0; row < layer(k).rows; ++row) layer(k).read_row(heights, row, k);
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
      for (int z = std::max(-1, k - before); z <= std::min(size[2], k + after); ++z) {
        for (int y = std::max(-1, j - before); y <= std::min(size[1], j + after); ++y) {
          const std::uint64_t* signs = layer(z).row_signs(y + 1);
          for (std::size_t w = 0; w < words; ++w) {
            some[w] |= signs[w];
            all[w] &= signs[w];
          }
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
        const std::uint64_t near = inside & ~only_inside;
        if (near != 0) visit(near, layer(k).row_signs(j + 1)[w], w, j, k);
      }
    }
  }
}

/// Calls visit(i, j, k) for each place -1 … size - 1 along x that is near the level so. In the order of k, then j, then
/// i.
template <class Visit>
void visit_near_level(const HeightGrid& heights, int before, int after, int begin, int end, Visit visit) {
  visit_words_near_level(heights, before, after, begin, end,
                         [&](std::uint64_t near, std::uint64_t, std::size_t word, int j, int k) {
                           for (; near != 0; near &= near - 1) {
                             const int i = static_cast<int>(64 * word) + std::countr_zero(near) - 1;
                             if (i < heights.size()[0]) visit(i, j, k);
                           }
                         });
}

}  // namespace scantet
