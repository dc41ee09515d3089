// Which regions the fields of a label map may have at a place, by intervals.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "scantet/base/parallel.h"
#include "scantet/base/progress.h"
#include "scantet/verify/label_source.h"
#include "scantet/verify/voxel_nodes.h"

namespace scantet::verify {

/// Regions of a cell, by their places in LabelCellValues, as bits.
using Candidates = std::uint8_t;

/// Those that may be the largest somewhere on a box within the cell (index coordinates), or level with it: no other is
/// surely larger by 1e-6 everywhere on it.
Candidates candidates(const LabelCellValues& fields, const Cell& cell, const Box& box);
/// Whether field n is surely larger than all others, by 1e-6, everywhere on the box.
bool surely_wins(const LabelCellValues& fields, std::size_t n, const Cell& cell, const Box& box);
/// Whether field n is at most 1e-6 above the largest of the others everywhere on the box, which is cut so often.
bool surely_not_above(const LabelCellValues& fields, std::size_t n, const Cell& cell, const Box& box, int depth);

inline bool is_one(Candidates c) {
  return (c & (c - 1)) == 0;
}

/// Whether the corners of a cell have one region, and which.
std::optional<Region> only_region(const LabelSource& labels, const Cell& cell);

/// Calls act(layer, cell) for each cell of a label map. Cells of one k are a layer, counted from 0; layers are looked
/// at side by side, each by one thread in the order of its cells. Ends early if cancelled.
template <class Act>
void for_cells(const LabelSource& labels, const Progress& progress, const Act& act) {
  const std::array<int, 3>& size = labels.size();
  parallel_for(static_cast<std::size_t>(size[2]) + 1, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t layer = begin; layer < end; ++layer) {
      const int k = static_cast<int>(layer) - 1;
      for (int j = -1; j < size[1] && !progress.cancelled(); ++j) {
        for (int i = -1; i < size[0]; ++i) act(layer, Cell{i, j, k});
      }
    }
  });
}

/// The region of all of a place that is known up to rounding, if that is sure; kOutside beyond the field's box.
std::optional<Region> sure_region(const LabelSource& labels, const IntervalVec& place);

}  // namespace scantet::verify
