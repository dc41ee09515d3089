// The rims of a cut: where the surfaces of a domain meet a plane.
#pragma once

#include <vector>

#include "scantet/cuts/clipped_curves.h"
#include "scantet/cuts/cut_lines.h"

namespace scantet {

/// What was found in a plane.
struct PlaneRims {
  bool meets_inside = false;  ///< some of the plane is in a region
  std::size_t unsettled = 0;  ///< points where regions meet in the plane, but no curve of the domain that comes there
};

/// Adds the rims in a plane, whose points are on the plane and on the domain's surfaces; the curves use the domain and
/// the plane, which must outlive them. lines, hits: of all planes. Source: marching squares over several regions.
PlaneRims find_rims(const CutSpace& space, std::size_t plane, const std::vector<CutLine>& lines,
                    const std::vector<CurveHit>& hits, CutCurves& found);

}  // namespace scantet
