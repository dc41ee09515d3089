// Sums of numbers that may not be known.
#pragma once

#include <cstdint>
#include <optional>

namespace scantet {

/// a + b; none if one of them is not known.
inline std::optional<std::int64_t> known_sum(std::optional<std::int64_t> a, std::optional<std::int64_t> b) {
  return a && b ? std::optional(*a + *b) : std::nullopt;
}

}  // namespace scantet
