#include "scantet/base/progress_share.h"

#include <gtest/gtest.h>

namespace scantet {
namespace {

double share(std::string_view stage, std::uint64_t done, std::optional<std::uint64_t> total, std::uint64_t pending) {
  return progress_share({stage, "", done, total, pending});
}

TEST(ProgressShare, GrowsFromStageToStage) {
  double last = 0;
  for (const char* stage : {"read", "sample", "refine", "optimize", "audit", "write"}) {
    EXPECT_GE(share(stage, 0, 10, 0), last);
    EXPECT_GT(share(stage, 5, 10, 0), share(stage, 0, 10, 0));
    EXPECT_EQ(share(stage, 10, 10, 0), share(stage, 30, 10, 0));
    last = share(stage, 10, 10, 0);
  }
  EXPECT_EQ(last, 1);
}

TEST(ProgressShare, GoesByWhatIsPendingWhereNobodyKnowsTheTotal) {
  EXPECT_LT(share("refine", 10, std::nullopt, 90), share("refine", 90, std::nullopt, 10));
  EXPECT_EQ(share("refine", 10, std::nullopt, 0), share("refine", 0, 10, 0));
  EXPECT_EQ(share("lunch", 1, 2, 0), 0);
}

}  // namespace
}  // namespace scantet
