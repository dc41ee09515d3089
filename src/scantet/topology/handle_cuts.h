// Which nodes change sides so that handles vanish and nothing else.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/topology/sided_nodes.h"

namespace scantet {

/// Nodes that change sides together.
struct HandleCut {
  std::vector<std::uint32_t> nodes;  ///< ascending
  bool inside = true;                ///< they were: a handle is cut; else a tunnel is filled
  std::int64_t handles = 0;          ///< how many vanish, > 0
  double width_mm = 0;               ///< how wide the side is there, about
};

/// What cut_handles() has done on one side.
struct HandleCuts {
  std::vector<HandleCut> made;
  std::vector<std::vector<std::uint32_t>> wide;  ///< groups by which handles would vanish too, but that are too wide
};

/// Turns nodes of one side, of cuts at most `width_mm` wide, so that handles vanish. Components of either side stay
/// what they are, with ties as SidedNodes has them. distances: as of level_distances() before any node was turned, of a
/// limit of width_mm / 2 or more. component_of: the component of each node; kept up to date. Of no use once
/// progress.cancelled() became true.
HandleCuts cut_handles(SidedNodes& nodes, bool inside, double width_mm, const std::array<double, 3>& spacing_mm,
                       const std::vector<float>& distances, std::vector<std::uint32_t>& component_of,
                       const Progress& progress);

/// By how many of the groups, which HandleCuts::wide told of the side, handles would still vanish. Pre: their nodes are
/// on that side.
std::size_t count_cuts(SidedNodes& nodes, bool inside, const std::vector<std::vector<std::uint32_t>>& groups,
                       const std::vector<float>& distances, std::vector<std::uint32_t>& component_of);

}  // namespace scantet
