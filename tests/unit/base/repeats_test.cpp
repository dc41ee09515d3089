#include "scantet/base/repeats.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace scantet {
namespace {

TEST(Repeats, EachValueIsLeftOnce) {
  std::mt19937 random(4);
  for (const std::size_t size : {0UL, 1UL, 2UL, 30UL, 128UL, 129UL, 1000UL}) {
    for (const unsigned spread : {1U, 7U, 5000U}) {
      std::vector<unsigned> values(size);
      for (unsigned& value : values) value = random() % spread;
      const std::set<unsigned> expected(values.begin(), values.end());
      drop_repeats(values);
      EXPECT_EQ(values.size(), expected.size());
      EXPECT_EQ(std::set<unsigned>(values.begin(), values.end()), expected);
    }
  }
}

}  // namespace
}  // namespace scantet
