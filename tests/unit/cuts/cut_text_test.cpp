#include "scantet/cuts/cut_text.h"

#include <gtest/gtest.h>

#include "error_code.h"

namespace scantet {
namespace {

std::vector<CutPlane> planes_of(const std::vector<std::string>& texts) {
  std::vector<CutPlane> planes;
  for (const std::string& text : texts) read_cut("--cut", text, planes);
  return planes;
}

TEST(CutText, KeepsWhatIsSaid) {
  for (const char* text : {"x < 10", "10 > x", "x<=10", "+x<1e1", "2x < 20", "2*x < 20"}) {
    const auto planes = planes_of({text});
    ASSERT_EQ(planes.size(), 1U) << text;
    EXPECT_EQ(planes[0].normal, (Vec{1, 0, 0})) << text;
    EXPECT_DOUBLE_EQ(planes[0].offset_mm, 10) << text;
    EXPECT_EQ(planes[0].name, "cut_1");
    EXPECT_FALSE(planes[0].is_border());
  }
  const auto above = planes_of({"z > -40.5"});
  EXPECT_EQ(above[0].normal, (Vec{0, 0, -1}));
  EXPECT_EQ(above[0].offset_mm, 40.5);
  const auto tilted = planes_of({"3x - 4z > -5"});
  EXPECT_LT(tilted[0].beyond_mm({0, 0, 0}), 0);
  EXPECT_NEAR(tilted[0].beyond_mm({-5.0 / 3, 7, 0}), 0, 1e-12);
}

TEST(CutText, TwoBoundsAreTwoPlanes) {
  for (const char* text : {"-10 < y < 20", "20 > y > -10"}) {
    const auto planes = planes_of({"x < 5", text});
    ASSERT_EQ(planes.size(), 3U);
    EXPECT_EQ(planes[1].name, "cut_2");
    EXPECT_EQ(planes[2].name, "cut_3");
    EXPECT_EQ(planes[1].normal, (Vec{0, -1, 0}));
    EXPECT_EQ(planes[1].offset_mm, 10);
    EXPECT_EQ(planes[2].offset_mm, 20);
  }
}

TEST(CutText, HasNames) {
  const auto planes = planes_of({"clamp: z > -40", "slab: 0 < x < 3"});
  ASSERT_EQ(planes.size(), 3U);
  EXPECT_EQ(planes[0].name, "clamp");
  EXPECT_EQ(planes[1].name, "slab_low");
  EXPECT_EQ(planes[2].name, "slab_high");
}

TEST(CutText, RefusesWhatIsNoPlane) {
  for (const char* text :
       {"",          "x",         "x = 3",     "x < y",         "x <",        "< 3",       "0x < 3",
        "x - x < 3", "x < 3 < 4", "3 < x > 4", "1 < x < 2 < 3", "4 < x < 3",  "w < 3",     "x < inf",
        "x < nan",   "x < 3mm",   "2 < 3",     ": x < 3",       "a b: x < 3", "x + 1 < 3", "--x < 3"}) {
    EXPECT_EQ(test::error_code([&] { planes_of({text}); }), "usage.cut") << text;
  }
  EXPECT_EQ(test::error_code([&] { planes_of({"a: x < 3", "a: y < 3"}); }), "usage.cut");
}

}  // namespace
}  // namespace scantet
