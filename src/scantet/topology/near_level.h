// Finds where a grid of heights is near the level, 64 nodes at a time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "scantet/field/run_sweep.h"

namespace scantet {

/// Calls visit(i, j, k) for the places -1 … size - 1 along x and y of the layers begin … end - 1, from k = -1 on, where
/// some of the nodes i - before … i + after, j - before … j + after, k - before … k + after are inside and some are
/// not. Nodes beyond the padding do not count. In the order of k, then j, then i.
template <class Visit>
void visit_near_level(const HeightGrid& heights, int before, int after, int begin, int end, Visit visit) {
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
      for (int i = -1; i < size[0]; ++i) {
        bool inside = false;
        bool outside = false;
        for (int x = std::max(-1, i - before); x <= std::min(size[0], i + after); ++x) {
          const auto bit = static_cast<std::size_t>(x + 1);
          inside = inside || (some[bit / 64] >> bit % 64 & 1) != 0;
          outside = outside || (all[bit / 64] >> bit % 64 & 1) == 0;
        }
        if (inside && outside) visit(i, j, k);
      }
    }
  }
}

}  // namespace scantet
