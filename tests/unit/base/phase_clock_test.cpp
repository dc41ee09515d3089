#include "scantet/base/phase_clock.h"

#include <gtest/gtest.h>

#include <string>

namespace scantet {
namespace {

class Listener final : public Progress {
 public:
  void report(const ProgressState& state) override {
    said += std::string(state.stage) + " " + std::string(state.doing) + " " + std::to_string(state.done) + "/" +
            (state.total ? std::to_string(*state.total) : "?") + "; ";
  }
  std::string said;
};

TEST(PhaseClock, AccountsForPhasesInOrderAndShowsThem) {
  std::vector<PhaseAccount> accounts;
  Listener listener;
  {
    PhaseClock clock(accounts, listener);
    clock.begin("read", "input");
    clock.expect(5);
    clock.begin("audit", "faces", 2);
    clock.begin("audit", "facets", 3);
    EXPECT_EQ(accounts.size(), 2u) << "the third is under way";
    clock.end();
    clock.end();
    EXPECT_EQ(accounts.size(), 3u);
    clock.begin("write", "a.vtu");
  }
  ASSERT_EQ(accounts.size(), 4u) << "the last ends with the clock";
  EXPECT_EQ(accounts[1].stage, "audit");
  EXPECT_EQ(accounts[1].part, "faces");
  EXPECT_EQ(listener.said, "read input 0/?; audit faces 0/5; audit facets 2/5; write a.vtu 5/5; ");
}

TEST(PhaseClock, CountsWallTimeAndProcessorTime) {
  std::vector<PhaseAccount> accounts;
  Progress nobody;
  PhaseClock clock(accounts, nobody);
  clock.begin("audit", "busy");
  const Stopwatch watch;
  volatile double sum = 0;
  while (watch.seconds() < 0.02) sum = sum + 1;
  clock.end();
  EXPECT_GE(accounts[0].seconds, 0.02);
  EXPECT_GT(accounts[0].cpu_seconds, 0);
}

}  // namespace
}  // namespace scantet
