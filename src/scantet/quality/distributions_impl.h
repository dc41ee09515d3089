// From values to their distribution. Private to quality/.
#pragma once

#include <span>

#include "scantet/quality/quality.h"

namespace scantet {

inline constexpr std::size_t kBins = 40;

/// Each takes the values in any order, and works on several threads; what comes out does not depend on how many.

/// Even bins from low to high.
Distribution over_range(std::span<const double> values, double low, double high, std::size_t bins);
/// kBins even bins over the finite values.
Distribution over_data(std::span<const double> values);
/// kBins even bins from low to high, and one more for all above, as wide as the others at least.
Distribution over_range_and_above(std::span<const double> values, double low, double high);

/// That of the same values times a positive factor.
Distribution scaled(Distribution distribution, double factor);

}  // namespace scantet
