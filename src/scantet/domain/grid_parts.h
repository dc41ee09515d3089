// What hangs together in a grid of regions.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/domain/region_grid.h"

namespace scantet {

/// Sets of a grid's runs, each with a number for every run, from 0 on in the order of their first runs.
///
/// Nodes of a region that are neighbours along an axis are joined in every field of the grid. Where they touch by an
/// edge or a corner of voxels only, a field may join them or part them; those of two parts that do not touch it parts.
struct GridParts {
  std::vector<std::uint32_t> joined;    ///< nodes of a region that are neighbours along axes
  std::vector<std::uint32_t> pieces;    ///< nodes of one of the grid's parts that touch
  std::vector<std::uint32_t> touching;  ///< nodes of a region that touch, or that the grid has in one part
};

GridParts find_parts(const RegionGrid& grid);

/// Nodes of kOutside, as runs whose parts are sets of nodes that touch: row by row as in RegionGrid::runs.
struct GridGaps {
  std::vector<GridRun> runs;
  std::vector<std::uint8_t> is_bounded;  ///< one a part: whether no node of it is at the border of the grid
};

GridGaps find_gaps(const RegionGrid& grid);

}  // namespace scantet
