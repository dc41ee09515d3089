// Where the largest of several fields changes along a segment in a cell.
#pragma once

#include <vector>

#include "scantet/labels/label_field.h"

namespace scantet {

/// From t on, up to the next change, the point belongs to `region`.
struct RegionChange {
  double t = 0;  ///< 0 at the segment's start, 1 at its end
  Region region = kOutside;
};

/// The regions along a segment in a cell of several.
struct RegionsAlong {
  Region at_start = kOutside;  ///< LabelCell::region_at(a)
  Region at_end = kOutside;    ///< LabelCell::region_at(b)
  /// In order of t, strictly between 0 and 1 or, where rounding or a tie decides, at the ends; each differs from the
  /// one before, the first from `before`. The last is the region just before the end.
  std::vector<RegionChange> changes;
};

/// Finds all changes along the segment from a to b, in local coordinates within [0, 1]. before: the region that the
/// segment comes from. `out` is overwritten, its memory reused. Guarantees: each t is a root of the difference of two
/// fields, as exact as sign_changes() gives it; where the fields of two regions tie along a stretch to rounding, there
/// is no change.
void find_region_changes(const LabelCell& cell, const Vec& a, const Vec& b, Region before, RegionsAlong& out);

}  // namespace scantet
