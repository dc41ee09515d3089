// Angles of several edges at once.
#pragma once

#include <array>

namespace scantet {

/// The angles, degrees, 0 … 180, whose sines and cosines are in these proportions; 0 where both are zero. sines: at
/// least 0. The same as atan2 gives, but for the last digit or two, and several times as fast: all are computed side by
/// side. Guarantees: the same on every machine.
std::array<double, 6> angles_deg(const std::array<double, 6>& sines, const std::array<double, 6>& cosines);

}  // namespace scantet
