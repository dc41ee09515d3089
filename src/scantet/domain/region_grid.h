// What an input that is a grid of regions, a segmentation, knows of them: to hold a mesh against.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/frame.h"
#include "scantet/base/stratum.h"

namespace SCANTET_API scantet {

/// Nodes (begin, j, k) to (end - 1, j, k), by their indices, all of one region that is not kOutside.
struct GridRun {
  std::int32_t j = 0;
  std::int32_t k = 0;
  std::int32_t begin = 0;
  std::int32_t end = 0;
  std::uint32_t part = 0;  ///< which of RegionGrid::parts they belong to
};

/// A connected part of a region; which nodes are connected says whoever makes the grid.
struct GridPart {
  Region region = kOutside;
  std::uint64_t nodes = 0;    ///< how many it has
  std::array<int, 3> node{};  ///< the index of one of them
};

/// A region of the grid.
struct GridRegion {
  Region region = kOutside;
  std::uint64_t nodes = 0;  ///< how many it has, in all its parts
  double volume_mm3 = 0;    ///< of the domain's region, which is not that of its nodes' cells; NaN: not known
};

/// The nodes of a grid and which region each is in; those of no run are in kOutside.
struct RegionGrid {
  Frame frame;                      ///< node index to world mm
  std::array<int, 3> size{};        ///< nodes along each axis
  std::vector<GridRun> runs;        ///< ascending by k, j and begin
  std::vector<GridPart> parts;      ///< in the order of their first runs
  std::vector<GridRegion> regions;  ///< those with nodes, ascending, without kOutside
  bool is_cut = false;              ///< by planes, so that what lies between two nodes of kOutside may be in regions
};

}  // namespace scantet
