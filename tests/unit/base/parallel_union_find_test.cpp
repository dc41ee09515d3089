#include "scantet/base/parallel_union_find.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "scantet/base/parallel.h"
#include "scantet/base/union_find.h"

namespace scantet {
namespace {

TEST(ParallelUnionFind, JoinsAsUnionFindDoesWhateverTheThreads) {
  constexpr std::uint32_t kLabels = 200'000;
  std::mt19937 random(5);
  std::vector<std::array<std::uint32_t, 2>> pairs(kLabels);
  for (auto& [a, b] : pairs) {
    a = random() % kLabels;
    b = random() % 10 == 0 ? static_cast<std::uint32_t>(random() % kLabels)
                           : std::min<std::uint32_t>(a + random() % 5, kLabels - 1);
  }
  UnionFind expected(kLabels);
  for (const auto& [a, b] : pairs) expected.unite(a, b);
  for (const std::size_t threads : {1, 4}) {
    with_threads(threads, [&] {
      ParallelUnionFind sets(kLabels);
      parallel_for(pairs.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) sets.unite(pairs[i][0], pairs[i][1]);
      });
      for (std::uint32_t label = 0; label < kLabels; ++label) {
        ASSERT_EQ(sets.find(label), expected.find(label));
        ASSERT_EQ(sets.is_root(label), expected.find(label) == label);
      }
    });
  }
}

}  // namespace
}  // namespace scantet
