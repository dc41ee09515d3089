// Pieces of a cell and their Euler numbers, against a fine grid of samples in it, and against the other side.
#include "scantet/verify/cell_parts.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <utility>
#include <vector>

#include "scantet/base/union_find.h"

namespace scantet::verify {
namespace {

double value(const std::array<double, 8>& v, double x, double y, double z) {
  double sum = 0;
  for (std::size_t c = 0; c < 8; ++c) {
    sum += (c & 1 ? x : 1 - x) * (c & 2 ? y : 1 - y) * (c & 4 ? z : 1 - z) * v[c];
  }
  return sum;
}

/// Pieces and the Euler number of the cubes' complex whose nodes are the positive samples.
std::pair<int, int> sampled(const std::array<double, 8>& v, int count) {
  const auto at = [&](int i, int j, int k) { return (k * (count + 1) + j) * (count + 1) + i; };
  std::vector<char> in(static_cast<std::size_t>(at(count, count, count) + 1));
  for (int k = 0; k <= count; ++k) {
    for (int j = 0; j <= count; ++j) {
      for (int i = 0; i <= count; ++i) {
        in[static_cast<std::size_t>(at(i, j, k))] =
            value(v, i / double(count), j / double(count), k / double(count)) > 0;
      }
    }
  }
  UnionFind sets(in.size());
  int euler = 0;
  int pieces = 0;
  for (int k = 0; k <= count; ++k) {
    for (int j = 0; j <= count; ++j) {
      for (int i = 0; i <= count; ++i) {
        for (int axes = 0; axes < 8; ++axes) {
          bool all = true;
          for (int c = 0; c < 8 && all; ++c) {
            if ((c & axes) != c) continue;
            const int x = i + (c & 1);
            const int y = j + (c >> 1 & 1);
            const int z = k + (c >> 2);
            all = x <= count && y <= count && z <= count && in[static_cast<std::size_t>(at(x, y, z))] != 0;
          }
          if (!all) continue;
          euler += std::popcount(static_cast<unsigned>(axes)) % 2 == 0 ? 1 : -1;
          if (std::popcount(static_cast<unsigned>(axes)) == 1) {
            sets.unite(static_cast<std::uint32_t>(at(i, j, k)),
                       static_cast<std::uint32_t>(at(i + (axes & 1), j + (axes >> 1 & 1), k + (axes >> 2))));
          }
        }
      }
    }
  }
  for (std::uint32_t n = 0; n < in.size(); ++n) pieces += in[n] != 0 && sets.find(n) == n;
  return {pieces, euler};
}

std::pair<int, int> counted(const CellPart& part) {
  int pieces = 0;
  int euler = 0;
  for (std::size_t c = 0; c < 8; ++c) {
    if ((part.members >> c & 1) == 0 || part.piece[c] != c) continue;
    ++pieces;
    euler += part.euler[c];
  }
  return {pieces, euler};
}

TEST(CellParts, AreWhatSamplesSay) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> any(-40, 40);
  int compared = 0;
  int with_tunnel = 0;
  for (int n = 0; n < 6000; ++n) {
    std::array<double, 8> v;
    for (double& x : v) x = any(random) + 0.5;
    if (n % 2 != 0) {  // corners of alternating signs: where parts join through the body
      for (unsigned c = 0; c < 8; ++c)
        v[c] = std::abs(v[c]) * (std::popcount(c) % 2 == 0 || (n % 4 == 1 && c == 7) ? 1 : -1);
    }
    const auto coarse = sampled(v, 12);
    if (coarse != sampled(v, 17)) continue;  // too thin for samples
    const CellPart part = part_in_cell(v, 0, 1);
    ASSERT_TRUE(part.is_known);
    if (counted(part) != coarse) {  // still too thin
      ASSERT_EQ(counted(part), sampled(v, 90)) << "cell " << n << ": " << ::testing::PrintToString(v);
    }
    ++compared;
    with_tunnel += coarse.first != coarse.second;
  }
  EXPECT_GT(compared, 3000);
  EXPECT_GT(with_tunnel, 5);
}

TEST(CellParts, DoNotDependOnWhichWayTheCellLies) {
  std::mt19937 random(8);
  std::uniform_int_distribution<int> any(-3, 3);  // many ties
  int known = 0;
  for (int n = 0; n < 20000; ++n) {
    std::array<double, 8> v;
    for (double& x : v) x = any(random);
    const CellPart part = part_in_cell(v, 0, n % 2 == 0 ? 1 : -1);
    const auto turned = [&](auto corner) {
      std::array<double, 8> w;
      for (unsigned c = 0; c < 8; ++c) w[c] = v[corner(c)];
      return part_in_cell(w, 0, n % 2 == 0 ? 1 : -1);
    };
    for (const CellPart& other :
         {turned([](unsigned c) { return (c << 1 & 6) | c >> 2; }), turned([](unsigned c) { return c ^ 5; }),
          turned([](unsigned c) { return (c & 1) << 2 | (c & 2) | c >> 2; })}) {
      if (!part.is_known || !other.is_known) continue;
      ++known;
      ASSERT_EQ(counted(part), counted(other)) << "cell " << n;
    }
  }
  EXPECT_GT(known, 58000);
}

}  // namespace
}  // namespace scantet::verify
