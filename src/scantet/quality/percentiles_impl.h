// The percentiles of many values. Private to quality/.
#pragma once

#include <array>
#include <span>

#include "scantet/quality/quality.h"

namespace scantet {

/// Those of kPercentiles, as Distribution has them; what is not finite is beyond all that is. Works on several threads;
/// the outcome does not depend on how many. values: at least one.
std::array<double, kPercentiles.size()> percentiles_of(std::span<const double> values);

}  // namespace scantet
