// How the lines between regions run through a convex piece of a plane, from where they cross its border.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "scantet/domain/domain.h"

namespace scantet {

/// A change of region on the way around the piece, counterclockwise.
struct BorderCrossing {
  std::uint32_t node;
  Point point;
  Region from;
  Region to;
};

/// What the piece's lines join.
struct SquareLines {
  struct Join {
    BorderCrossing start;  ///< left of the way from here to the end is start.from, right of it start.to
    BorderCrossing end;
  };
  std::vector<Join> joins;
  std::vector<BorderCrossing> junction;  ///< what is left: three or more lines that meet in the piece
};

/// Joins crossings that follow each other and lead into a region and back; where there is a choice, those around what
/// is not the region in the middle, and the nearest ones. region_at: of the domain.
SquareLines join_crossings(std::vector<BorderCrossing> crossings, const std::function<Region(const Point&)>& region_at);

}  // namespace scantet
