// The lines in a plane along which the regions of a domain meet, found in the squares of a grid.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scantet/cuts/cut_lines.h"
#include "scantet/cuts/plane_axes.h"

namespace scantet {

/// A point where links end.
struct RimNode {
  Point point;
  std::optional<std::size_t> corner;  ///< of CutCurves::corners, if it is one
  bool is_junction = false;           ///< in the middle of a square in which three regions or more meet
};

/// A piece of a line along which two regions meet, seen from beyond the plane.
struct RimLink {
  std::array<std::uint32_t, 2> nodes;
  Region left;
  Region right;
  std::uint64_t square;  ///< the one it lies in
};

struct RimGraph {
  std::vector<RimNode> nodes;
  std::vector<RimLink> links;
  double step_mm = 0;         ///< width of a square
  std::uint64_t columns = 0;  ///< of squares; square n is in column n % columns of row n / columns
  bool meets_inside = false;  ///< some of the plane is in a region
};

/// Every part of a region in the plane that is wider than a square is found: each line of the grid is one query, which
/// finds all that it crosses. Squares are space.step_mm wide, or as wide that they are no more than 16 million. lines:
/// those of find_cut_lines(); the graph ends at their places. Depends on the arguments alone.
RimGraph trace_rims(const CutSpace& space, std::size_t plane, const std::vector<CutLine>& lines);

}  // namespace scantet
