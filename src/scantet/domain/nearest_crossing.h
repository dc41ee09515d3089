// Which of several crossings is nearest to a point.
#pragma once

#include <span>

#include "scantet/domain/domain.h"

namespace scantet {

/// Of the crossings that count, the one nearest to p, of equals the first; null if none counts. counts(crossing):
/// whether one does.
template <class Counts>
const Crossing* nearest_crossing(std::span<const Crossing> crossings, const Point& p, const Counts& counts) {
  const Crossing* nearest = nullptr;
  double least = 0;
  for (const Crossing& crossing : crossings) {
    if (!counts(crossing)) continue;
    const double squared = squared_distance(crossing.point, p);
    if (nearest != nullptr && squared >= least) continue;
    least = squared;
    nearest = &crossing;
  }
  return nearest;
}

/// Of all.
inline const Crossing* nearest_crossing(std::span<const Crossing> crossings, const Point& p) {
  return nearest_crossing(crossings, p, [](const Crossing&) { return true; });
}

}  // namespace scantet
