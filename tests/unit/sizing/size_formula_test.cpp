#include "scantet/sizing/size_formula.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scantet/base/error.h"

namespace scantet {
namespace {

double value_of(const std::string& text, const SizePlace& place) {
  double size = 0;
  SizeFormula(text, "--size").sizes_at({&place, 1}, {&size, 1});
  return size;
}

std::string refusal_of(const std::string& text) {
  try {
    SizeFormula(text, "--size");
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::usage);
    EXPECT_EQ(error.code(), "usage.formula");
    return error.what();
  }
  return "accepted";
}

TEST(SizeFormula, KnowsThePlaceTheDepthAndTheRegion) {
  const SizePlace place{{1, 2, 3}, 4, 5};
  EXPECT_EQ(value_of("x + 10*y + 100*z + 1000*d + 10000*region", place), 54321);
  EXPECT_EQ(value_of("region == 5 ? min(x, 7) : 2^3", place), 1);
  EXPECT_NEAR(value_of("sqrt(d) + sin(pi)", place), 2, 1e-12);
  EXPECT_TRUE(std::isinf(value_of("x/0", place)));
}

TEST(SizeFormula, NeedsTheDepthOnlyIfItIsNamed) {
  EXPECT_TRUE(SizeFormula("1 + d", "--size").needs_depth());
  EXPECT_FALSE(SizeFormula("1 + x", "--size").needs_depth());
}

TEST(SizeFormula, SaysWhereTheMistakeIs) {
  EXPECT_NE(refusal_of("1 + foo").find("--size: \"1 + foo\" is not a size in mm: no number, auto or file, and as a "
                                       "formula it is wrong at character 5"),
            std::string::npos)
      << refusal_of("1 + foo");
  EXPECT_NE(refusal_of("1 + (x").find("it is wrong at character"), std::string::npos);
  EXPECT_NE(refusal_of("region = 2 ? 1 : 3").find("character 8: \"=\" assigns, == compares"), std::string::npos);
  EXPECT_NE(refusal_of("1, 2").find("it has several values"), std::string::npos);
  EXPECT_NE(refusal_of("1 - 2").find("nowhere finite and greater than 0"), std::string::npos);
  EXPECT_NE(refusal_of("").find("is not a size in mm"), std::string::npos);
}

}  // namespace
}  // namespace scantet
