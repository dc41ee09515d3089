// Finds the cells and nodes of interest in layers of signs, 64 at a time.
#pragma once

#include <bit>

#include "scantet/field/run_sweep.h"

namespace scantet {

/// Calls visit(i, j, pattern) for the cells between two layers whose corners differ in sign, in the order of j, then i.
/// pattern: bit c is set if corner c is inside (CellHeights has the order).
template <class Visit>
void visit_mixed_cells(const SignLayer& below, const SignLayer& above, Visit visit) {
  for (int row = 0; row + 1 < below.rows; ++row) {
    if (!(below.some[row] || below.some[row + 1] || above.some[row] || above.some[row + 1])) continue;
    const std::uint64_t* corner_rows[4] = {below.row_signs(row), below.row_signs(row + 1), above.row_signs(row),
                                           above.row_signs(row + 1)};
    const auto any = [&](int w) {
      return corner_rows[0][w] | corner_rows[1][w] | corner_rows[2][w] | corner_rows[3][w];
    };
    const auto all = [&](int w) {
      return corner_rows[0][w] & corner_rows[1][w] & corner_rows[2][w] & corner_rows[3][w];
    };
    for (int w = 0; w < below.words; ++w) {
      const bool last = w + 1 == below.words;
      const std::uint64_t some = any(w) | any(w) >> 1 | (last ? 0 : any(w + 1) << 63);
      const std::uint64_t full = all(w) & (all(w) >> 1 | (last ? 0 : all(w + 1) << 63));
      for (std::uint64_t mixed = some & ~full; mixed != 0; mixed &= mixed - 1) {
        const int bit = std::countr_zero(mixed);
        unsigned pattern = 0;
        for (int n = 0; n < 4; ++n) {
          std::uint64_t pair = corner_rows[n][w] >> bit;
          if (bit == 63 && !last) pair |= corner_rows[n][w + 1] << 1;
          pattern |= static_cast<unsigned>(pair & 3) << 2 * n;
        }
        visit(64 * w + bit - 1, row - 1, pattern);
      }
    }
  }
}

/// Calls visit(i, j, differing) for the nodes of the image in the layer `here` that are narrow along the grid, in the
/// order of j, then i. differing: bit 2·axis is set if the neighbour at -1 along the axis has the other sign, bit
/// 2·axis + 1 if that at +1 has. A node is narrow if all six neighbours differ (an island or a hole of one node), if
/// all but the two along one axis do (a thread), or if just those two do (a sheet).
template <class Visit>
void visit_narrow_nodes(const SignLayer& below, const SignLayer& here, const SignLayer& above, Visit visit) {
  for (int row = 1; row + 1 < here.rows; ++row) {
    if (!(here.some[row] || here.some[row - 1] || here.some[row + 1] || below.some[row] || above.some[row])) continue;
    const std::uint64_t* signs = here.row_signs(row);
    for (int w = 0; w < here.words; ++w) {
      const std::uint64_t s = signs[w];
      const std::uint64_t before = s << 1 | (w > 0 ? signs[w - 1] >> 63 : 0);
      const std::uint64_t after = s >> 1 | (w + 1 < here.words ? signs[w + 1] << 63 : 0);
      const std::uint64_t differ[6] = {s ^ before,
                                       s ^ after,
                                       s ^ here.row_signs(row - 1)[w],
                                       s ^ here.row_signs(row + 1)[w],
                                       s ^ below.row_signs(row)[w],
                                       s ^ above.row_signs(row)[w]};
      const std::uint64_t both[3] = {differ[0] & differ[1], differ[2] & differ[3], differ[4] & differ[5]};
      const std::uint64_t none[3] = {~(differ[0] | differ[1]), ~(differ[2] | differ[3]), ~(differ[4] | differ[5])};
      std::uint64_t narrow = both[0] & both[1] & both[2];
      for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        narrow |= (none[axis] & both[u] & both[v]) | (both[axis] & none[u] & none[v]);
      }
      for (; narrow != 0; narrow &= narrow - 1) {
        const int bit = std::countr_zero(narrow);
        const int i = 64 * w + bit - 1;
        if (i < 0 || i + 2 >= here.width) continue;  // padding
        unsigned differing = 0;
        for (int n = 0; n < 6; ++n) differing |= static_cast<unsigned>(differ[n] >> bit & 1) << n;
        visit(i, row - 1, differing);
      }
    }
  }
}

}  // namespace scantet
