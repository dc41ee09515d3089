// The lines where two planes meet.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "scantet/cuts/cut_space.h"

namespace scantet {

/// Curves, and the corners that these refer to.
struct CutCurves {
  std::vector<std::shared_ptr<const Curve>> curves;
  std::vector<Corner> corners;
};

/// Where the domain's region changes along the line of two planes, in the stretch that the other planes leave of it.
struct CutLine {
  /// A change, from region to region.
  struct Place {
    double along_mm;  ///< from the origin
    Point point;
    Region from;
    Region to;
    std::size_t corner;  ///< of CutCurves::corners
  };
  std::array<std::size_t, 2> planes{};
  Point origin;
  Vec along;  ///< of unit length
  std::vector<Place> places;

  double along_mm(const Point& p) const { return dot(along, p - origin); }
};

/// All such lines, in the order of their planes; those of parallel planes are left out. Adds the edges of the cut
/// object along them, and their corners.
std::vector<CutLine> find_cut_lines(const CutSpace& space, CutCurves& found);

}  // namespace scantet
