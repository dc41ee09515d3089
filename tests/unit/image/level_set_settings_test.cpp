// What make_level_set refuses, and what it says.
#include <gtest/gtest.h>

#include "scantet/base/error.h"
#include "scantet/image/level_set.h"
#include "unit/image/test_scan.h"

namespace scantet {
namespace {

Scan ramp() {
  return test::scan_of_function<std::uint8_t>({6, 4, 4}, [](int i, int, int) { return 10 * i; });
}

/// Checks code and fault of the error and returns its text.
std::string refusal(const Scan& scan, const LevelSetSettings& settings, Fault fault, const std::string& code) {
  try {
    make_level_set(scan, settings);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), fault);
    EXPECT_EQ(error.code(), code);
    EXPECT_FALSE(error.remedy().empty());
    return error.what();
  }
  ADD_FAILURE() << "level " << settings.level << " was accepted";
  return {};
}

TEST(LevelSetSettings, LevelWithNothingInsideOrOutside) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double level : {50.0, 60.0, -0.5, nan, infinity, -infinity}) {
    const std::string text = refusal(ramp(), {level, InsideSide::above, {}}, Fault::input, "input.level");
    EXPECT_NE(text.find("between 0 and 50"), std::string::npos) << text;
  }
  for (const double level : {0.0, -3.0, 50.5}) {
    const std::string text = refusal(ramp(), {level, InsideSide::below, {}}, Fault::input, "input.level");
    EXPECT_NE(text.find("inside is below"), std::string::npos) << text;
  }
  EXPECT_NE(refusal(ramp(), {50.25, InsideSide::above, {}}, Fault::input, "input.level").find("level 50.25"),
            std::string::npos);
}

TEST(LevelSetSettings, LevelAtTheEndsOfTheRange) {
  EXPECT_NE(make_level_set(ramp(), {0, InsideSide::above, {}}), nullptr);
  EXPECT_NE(make_level_set(ramp(), {50, InsideSide::below, {}}), nullptr);
}

TEST(LevelSetSettings, ConstantScan) {
  const Scan scan = test::scan_of_function<float>({3, 3, 3}, [](int, int, int) { return 7.5; });
  for (const double level : {7.5, 7.0, 8.0}) {
    const std::string text = refusal(scan, {level, InsideSide::above, {}}, Fault::input, "input.level");
    EXPECT_NE(text.find("7.5"), std::string::npos) << text;
  }
}

TEST(LevelSetSettings, OutsideValueOnTheInsideOrNotANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double outside : {25.5, 1000.0, nan, infinity, -infinity, -1e9}) {
    refusal(ramp(), {25, InsideSide::above, outside}, Fault::usage, "usage.outside");
  }
  for (const double outside : {24.5, -1000.0, nan, infinity, -infinity, 1e9}) {
    refusal(ramp(), {25, InsideSide::below, outside}, Fault::usage, "usage.outside");
  }
  EXPECT_NE(make_level_set(ramp(), {25, InsideSide::above, -20000.0}), nullptr);
  EXPECT_NE(make_level_set(ramp(), {25, InsideSide::below, 25.0}), nullptr);
}

}  // namespace
}  // namespace scantet
