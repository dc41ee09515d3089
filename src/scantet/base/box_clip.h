// Where a segment is in a box.
#pragma once

#include <optional>

#include "scantet/base/api.h"
#include "scantet/base/geometry.h"

namespace SCANTET_API scantet {

/// A stretch of a segment, as shares of its length, and through which walls of a box it goes in and out there.
struct ClippedStretch {
  double enter = 0;     ///< 0 if the source is in the box
  double leave = 1;     ///< 1 if the target is
  int enter_axis = -1;  ///< across which the wall lies; -1 if it starts in the box
  int leave_axis = -1;  ///< the same where it leaves
};

/// The stretch of the segment from `source` to source + `along` that is in the box, whose walls belong to it; none if
/// there is none. along: may be zero. box: may be empty. Rounding: of one subtraction and one division for each wall,
/// so that a place at the stretch's end may be beside its wall by a rounding error.
inline std::optional<ClippedStretch> clip_to_box(const Point& source, const Vec& along, const Box& box) {
  ClippedStretch stretch;
  for (int axis = 0; axis < 3; ++axis) {
    if (along[axis] == 0) {
      if (!(source[axis] >= box.min[axis] && source[axis] <= box.max[axis])) return std::nullopt;
      continue;
    }
    const bool upward = along[axis] > 0;
    const double enter = ((upward ? box.min : box.max)[axis] - source[axis]) / along[axis];
    const double leave = ((upward ? box.max : box.min)[axis] - source[axis]) / along[axis];
    if (enter > stretch.enter) {
      stretch.enter = enter;
      stretch.enter_axis = axis;
    }
    if (leave < stretch.leave) {
      stretch.leave = leave;
      stretch.leave_axis = axis;
    }
  }
  if (!(stretch.enter <= stretch.leave)) return std::nullopt;
  return stretch;
}

/// The part of the segment that is in the box, as of clip_to_box(). An end in the box stays as it is.
inline std::optional<Segment> clipped(const Segment& segment, const Box& box) {
  const auto stretch = clip_to_box(segment.source, segment.target - segment.source, box);
  if (!stretch) return std::nullopt;
  return Segment{stretch->enter == 0 ? segment.source : lerp(segment.source, segment.target, stretch->enter),
                 stretch->leave == 1 ? segment.target : lerp(segment.source, segment.target, stretch->leave)};
}

}  // namespace scantet
