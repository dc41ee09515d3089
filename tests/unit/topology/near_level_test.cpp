// Against a plain loop over the nodes around.
#include "scantet/topology/near_level.h"

#include <gtest/gtest.h>

#include <set>

#include "unit/image/test_scan.h"

namespace scantet {
namespace {

using namespace test;
using Node = std::array<int, 3>;

class NearLevel : public testing::TestWithParam<int> {};

// Rows of one word, of one that is full, of two, and of two that are full.
INSTANTIATE_TEST_SUITE_P(Widths, NearLevel, testing::Values(20, 62, 63, 70, 126));

TEST_P(NearLevel, ThePlacesAreThoseWithBothSignsAround) {
  const std::array<int, 3> size{GetParam(), 9, 8};
  const auto scan = scan_of_function<float>(size, [](int i, int j, int k) {
    return (i * 7 + j * 13 + k * 29) % 97 == 0 || (i > GetParam() - 10 && j > 3) ? 1.0 : -1.0;
  });
  const auto heights = make_height_grid(scan, {0, InsideSide::above, -1.0});
  for (const auto& [before, after] : {std::pair{0, 1}, {1, 2}, {2, 2}}) {
    std::set<Node> expected;
    for (int k = -1; k < size[2]; ++k) {
      for (int j = -1; j < size[1]; ++j) {
        for (int i = -1; i < size[0]; ++i) {
          std::set<bool> signs;
          for (int z = std::max(-1, k - before); z <= std::min(size[2], k + after); ++z) {
            for (int y = std::max(-1, j - before); y <= std::min(size[1], j + after); ++y) {
              for (int x = std::max(-1, i - before); x <= std::min(size[0], i + after); ++x) {
                signs.insert(heights->height(x, y, z) > 0);
              }
            }
          }
          if (signs.size() == 2) expected.insert({k, j, i});
        }
      }
    }
    std::vector<Node> found;
    for (const auto& [begin, end] : {std::pair{-1, 3}, {3, size[2]}}) {
      visit_near_level(*heights, before, after, begin, end, [&](int i, int j, int k) { found.push_back({k, j, i}); });
    }
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    EXPECT_EQ(std::set<Node>(found.begin(), found.end()), expected) << before << " before, " << after << " after";
    EXPECT_EQ(found.size(), expected.size());
    EXPECT_LT(found.size(), (size[0] + 1U) * 10 * 9) << "some places are far from the level";
  }
}

}  // namespace
}  // namespace scantet
