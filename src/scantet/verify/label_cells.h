// Which regions the fields of a label map may have at a place, by intervals.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

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

/// The region of all of a place that is known up to rounding, if that is sure; kOutside beyond the field's box.
std::optional<Region> sure_region(const LabelSource& labels, const IntervalVec& place);

}  // namespace scantet::verify
