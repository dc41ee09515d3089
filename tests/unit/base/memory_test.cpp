#include "scantet/base/memory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace scantet {
namespace {

TEST(Memory, WhatIsHeldAndAvailableIsKnown) {
  const double before = resident_bytes();
  EXPECT_GT(before, 1e6);
  constexpr std::size_t kMore = 64 << 20;
  const std::string more(kMore, 'x');
  EXPECT_GT(resident_bytes(), before + 0.9 * static_cast<double>(more.size()));
  EXPECT_GT(available_bytes(), 1e6);
  EXPECT_TRUE(std::isfinite(available_bytes()));
  EXPECT_GT(physical_bytes(), resident_bytes());
}

}  // namespace
}  // namespace scantet
