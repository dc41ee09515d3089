#include "scantet/base/coordinate_hash.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

namespace scantet {
namespace {

/// Meshes depend on it, so it may not change.
TEST(CoordinateHash, StaysAsItIs) {
  EXPECT_EQ(hash_of_coordinates({0, 0, 0}), 0U);
  EXPECT_EQ(hash_of_coordinates({1, 2, 3}), 0xe2a5ca37e697f70eULL);
  EXPECT_EQ(hash_of_coordinates({1, 2, 3}, {0x9e3779b97f4a7c15ULL, 32}), 0x982086583000db6ULL);
}

TEST(CoordinateHash, TellsPointsSeedsAndMixingsApart) {
  std::set<std::uint64_t> hashes;
  std::size_t asked = 0;
  for (int n = 0; n < 1000; ++n, asked += 3) {
    const Point p{n % 10 * 0.5, n / 10 % 10 * 0.5, n / 100 * 0.5 + 1};
    hashes.insert(hash_of_coordinates(p));
    hashes.insert(hash_of_coordinates(p, {kUsualMixing.multiplier, 31}));
    hashes.insert(hash_of_coordinates(p, kUsualMixing, 7));
  }
  EXPECT_EQ(hashes.size(), asked);
}

/// Of the points of a lattice, whose coordinates differ in few bits, about half have any one bit of the hash set.
TEST(CoordinateHash, SpreadsOverAllBits) {
  constexpr int kEdge = 32;
  constexpr int kPoints = kEdge * kEdge * kEdge;
  std::array<int, 64> set{};
  for (int n = 0; n < kPoints; ++n) {
    const std::uint64_t hash = hash_of_coordinates({1.0 + n % kEdge, 1.0 + n / kEdge % kEdge, 1.0 + n / kEdge / kEdge});
    for (std::size_t bit = 0; bit < 64; ++bit) set[bit] += static_cast<int>(hash >> bit & 1);
  }
  for (const int count : set) EXPECT_NEAR(count, kPoints / 2, 0.1 * kPoints);
}

}  // namespace
}  // namespace scantet
