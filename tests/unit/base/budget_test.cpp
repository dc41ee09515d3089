#include "scantet/base/budget.h"

#include <gtest/gtest.h>

namespace scantet {
namespace {

/// Cancelled on demand; keeps the last stage.
class Switch final : public Progress {
 public:
  void report(const ProgressState& state) override { stage = state.stage; }
  bool cancelled() const override { return on; }
  bool on = false;
  std::string stage;
};

TEST(Budget, WithoutBoundsItIsTheProgressInIt) {
  Switch inner;
  Budget budget(inner, std::nullopt, std::nullopt);
  budget.report({"refine", "R1", 0, std::nullopt, 0});
  EXPECT_EQ(inner.stage, "refine");
  EXPECT_FALSE(budget.cancelled());
  inner.on = true;
  EXPECT_TRUE(budget.cancelled());
  EXPECT_FALSE(budget.out_of_budget());
  EXPECT_EQ(budget.end(), Budget::End::cancelled);
}

TEST(Budget, TimeAndMemoryEndItAndItKnowsWhatWasGoingOn) {
  Switch inner;
  Budget time(inner, 1e-9, std::nullopt);
  Budget memory(inner, std::nullopt, 1000);
  Budget ample(inner, 1e6, 1e15);
  for (Budget* budget : {&time, &memory, &ample}) budget->report({"refine", "R1", 0, std::nullopt, 0});
  EXPECT_EQ(time.end(), Budget::End::time);
  EXPECT_EQ(memory.end(), Budget::End::memory);
  EXPECT_TRUE(memory.out_of_budget());
  EXPECT_FALSE(ample.cancelled());
  time.report({"audit", {}, 0, std::nullopt, 0});
  EXPECT_EQ(time.busy_with(), "refine R1");
  inner.on = true;
  EXPECT_FALSE(time.out_of_budget()) << "who cancels wants nothing";
}

TEST(Budget, OnceClosedItDoesNotEnd) {
  Progress inner;
  Budget budget(inner, 1e-9, 1);
  budget.close();
  EXPECT_FALSE(budget.cancelled());
}

}  // namespace
}  // namespace scantet
