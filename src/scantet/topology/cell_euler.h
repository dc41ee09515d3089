// What the cells of a trilinear field add to the Euler numbers of the parts above and below a level.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scantet/field/run_sweep.h"

namespace scantet {

/// Adds, for every cell between the last two layers of a sweep, eight times its share of the Euler number of each part
/// of {h > 0} and of {h < 0} that reaches into it; the shares of all cells sum up to the Euler numbers. Nodes at the
/// level, and the edges and faces between them, count as outside of either side: count_ties() of level_ties.h adds what
/// that leaves out. What a saddle of a face at the level itself asks for is in the shares.
/// part_of: of each label of the sweep; eighths: by part, ≥ as many as there are.
void add_cell_shares(const HeightGrid& heights, const RunSweep& sweep, std::span<const std::uint32_t> part_of,
                     std::vector<std::int64_t>& eighths);

/// What a cell alone joins.
struct CellParts {
  std::array<std::uint8_t, 8> corners{};  ///< of each corner, as a set of bits, those of its sign that hang with it
  int eighths = 0;                        ///< the share of all that is above the level, as of add_cell_shares()
};

/// heights: none is 0. members: bit c is set if that of corner c is above it. A saddle of a face at the level itself
/// counts as below it.
CellParts cell_parts(unsigned members, const CellHeights& heights);

/// How far nodes at the level are taken to be below it if a cell that they are corners of lies in it wholly.
double little_below(const HeightGrid& heights);

}  // namespace scantet
