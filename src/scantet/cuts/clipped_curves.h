// The curves of a domain, cut by planes.
#pragma once

#include <vector>

#include "scantet/cuts/cut_lines.h"

namespace scantet {

/// A corner where a curve of the domain meets a plane.
struct CurveHit {
  std::size_t plane;
  std::size_t corner;  ///< of CutCurves::corners
};

/// Adds what the planes leave of the domain's curves, and their corners, those at the planes among them. Curves are
/// looked at in steps of half of space.step_mm: what leaves the kept side for less is not seen.
std::vector<CurveHit> clip_curves(const CutSpace& space, CutCurves& found);

}  // namespace scantet
