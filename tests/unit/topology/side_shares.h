// What cell by cell counts give for all that is above a level and all that is below it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scantet/field/run_sweep.h"
#include "scantet/topology/cell_euler.h"

namespace scantet::test {

/// The sums of add_cell_shares() below the level, with the unbounded outside, and above it.
inline std::array<std::int64_t, 2> shares_of_sides(const HeightGrid& heights) {
  std::vector<std::uint32_t> side_of{0};  // of labels
  RunSweep sweep(heights, -1, heights.size()[2]);
  std::vector<std::int64_t> eighths(2);
  while (sweep.advance(nullptr)) {
    const RunLayer& layer = sweep.layer();
    for (std::size_t run = 0; run < layer.side.size(); ++run) {
      if (layer.label[run] >= side_of.size()) side_of.resize(layer.label[run] + 1);
      if (layer.side[run] != 0) side_of[layer.label[run]] = layer.side[run] > 0 ? 1 : 0;
    }
    if (sweep.k() >= 0) add_cell_shares(heights, sweep, side_of, eighths);
  }
  return {eighths[0], eighths[1]};
}

}  // namespace scantet::test
