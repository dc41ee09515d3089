// What a point of a meshed object can lie on: a region, a patch of boundary, a curve, a corner.
#pragma once

#include <array>
#include <compare>
#include <cstdint>

#include "scantet/base/api.h"

namespace SCANTET_API scantet {

/// Which part of the domain a point is in, from 1 on; 0 is outside.
using Region = std::int32_t;
inline constexpr Region kOutside = 0;

/// Numbers a connected component of a region; a domain counts as it likes.
using ComponentId = std::uint32_t;

/// A piece of boundary between two regions. Equal patches are the same piece.
struct Patch {
  std::array<Region, 2> regions{kOutside, kOutside};  ///< on its two sides, ascending; both kOutside: not known
  /// Of the two regions, in their order: which of their components meet there. A domain that cannot tell them apart
  /// gives 0 for all; one that only tells pieces of boundary apart may number these in the second place.
  std::array<ComponentId, 2> components{};

  /// Whether it is one: a piece of boundary has a region on each side, which differ.
  bool is_known() const { return regions[0] != regions[1]; }
  friend bool operator==(const Patch&, const Patch&) = default;
  friend auto operator<=>(const Patch&, const Patch&) = default;
};

/// What a vertex lies on: a stratum of the domain, of the least dimension that holds it.
struct Stratum {
  std::int32_t index = 0;      ///< which one of its dimension; what it counts says whoever holds the stratum
  std::uint8_t dimension = 3;  ///< 3 the inside of a region, 2 a patch, 1 a curve, 0 a corner

  /// Whether it is a patch, a curve or a corner.
  bool on_boundary() const { return dimension < 3; }
  friend bool operator==(const Stratum&, const Stratum&) = default;
};

}  // namespace scantet
