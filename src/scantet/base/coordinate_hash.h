// Numbers that depend on nothing but coordinates: an order at random that is the same in every run, on every machine
// and for any number of threads.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "scantet/base/geometry.h"

namespace scantet {

/// How the bits of a hash are mixed. Hashes of a point that are to be independent of each other differ in it.
struct HashMixing {
  std::uint64_t multiplier;  ///< odd
  int shift;                 ///< by which upper bits come down to the lower ones after each multiplication
};

/// The usual one. The multiplier is one of SplitMix64's (Steele, Lea, Flood 2014).
inline constexpr HashMixing kUsualMixing{0xbf58476d1ce4e5b9ULL, 29};

/// A hash of three words. seed: another one gives another hash.
inline std::uint64_t hash_of_words(const std::array<std::uint64_t, 3>& words, HashMixing mixing = kUsualMixing,
                                   std::uint64_t seed = 0) {
  std::uint64_t hash = seed;
  for (const std::uint64_t word : words) {
    hash = (hash ^ word) * mixing.multiplier;
    hash ^= hash >> mixing.shift;
  }
  return hash;
}

/// The same of the bits of a point's coordinates: 0 and -0 differ.
inline std::uint64_t hash_of_coordinates(const Point& p, HashMixing mixing = kUsualMixing, std::uint64_t seed = 0) {
  const auto bits = [](double coordinate) { return std::bit_cast<std::uint64_t>(coordinate); };
  return hash_of_words({bits(p.x), bits(p.y), bits(p.z)}, mixing, seed);
}

}  // namespace scantet
