#include "scantet/size_options/size_plan_check.h"

#include <gtest/gtest.h>

#include "scantet/base/error.h"
#include "unit/nested_balls.h"

namespace scantet {
namespace {

/// The code of the error for these sizes of two balls, regions 1 and 2, whose size is 2 unless another is asked for;
/// empty if there is none.
std::string code_of(const std::string& inside, const std::string& boundary, std::vector<std::string> regions = {}) {
  SizeOptions options;
  options.size = inside;
  options.boundary_size = boundary;
  options.region_sizes = std::move(regions);
  OpenedDomain opened;
  opened.domain = std::make_unique<test::NestedBalls>(5, 10);
  opened.default_size_mm = 2;
  try {
    check_plan(plan_sizes(options), opened);
  } catch (const Error& error) {
    return error.code();
  }
  return "";
}

TEST(SizePlanCheck, RefusesASizeForARegionThatIsNotThere) {
  EXPECT_EQ(code_of("3", "", {"3=1"}), "usage.region_size");
  EXPECT_EQ(code_of("3", "", {"2=1", "1=2"}), "");
}

TEST(SizePlanCheck, RefusesANumberOnTheBoundaryThatIsNotLess) {
  EXPECT_EQ(code_of("3", "3"), "usage.no_effect");
  EXPECT_EQ(code_of("", "2.5"), "usage.no_effect");
  EXPECT_EQ(code_of("3", "2.5"), "");
  EXPECT_EQ(code_of("2", "2.5", {"1=3"}), "");  // less than in region 1
}

TEST(SizePlanCheck, LeavesFormulasAlone) {
  EXPECT_EQ(code_of("3", "3 + 0 * x"), "");
  EXPECT_EQ(code_of("3 + 0 * x", "3"), "");
}

}  // namespace
}  // namespace scantet
