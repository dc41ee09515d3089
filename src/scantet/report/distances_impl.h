// Distances between boundaries, in words.
#pragma once

#include <string>

#include "scantet/check/distance.h"

namespace scantet {

/// "0.62 to 0.75 mm", or "at least 0.62 mm (at 1,234 points, without a bound)"; "not measured" without points.
std::string distance_text(const OneWayDistance& distance);

}  // namespace scantet
