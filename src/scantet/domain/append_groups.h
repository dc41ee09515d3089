// Misplaced places from several looks as one list.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/domain/domain.h"

namespace scantet {

/// Adds places behind others, with groups of their own. Pre: in each list groups ascend.
inline void append_groups(const std::vector<Misplaced>& more, std::vector<Misplaced>& places) {
  const std::uint32_t first_group = places.empty() ? 0 : places.back().group + 1;
  for (const Misplaced& place : more) places.push_back({place.point, place.region, first_group + place.group});
}

}  // namespace scantet
