#include "scantet/app/machine_speed.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "scantet/base/error.h"

namespace scantet {
namespace {

TEST(MachineSpeed, IsMeasuredUnlessTheEnvironmentHasIt) {
  ::unsetenv("SCANTET_TRIAL");
  EXPECT_GT(trial_seconds(), 0);
  ::setenv("SCANTET_TRIAL", "1234.5", 1);
  EXPECT_EQ(trial_seconds(), 1234.5);
  ::setenv("SCANTET_TRIAL", "quick", 1);
  try {
    trial_seconds();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), "usage.value");
  }
  ::unsetenv("SCANTET_TRIAL");
}

}  // namespace
}  // namespace scantet
