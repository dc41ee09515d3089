#include "scantet/app/budget_options.h"

#include <gtest/gtest.h>

#include "scantet/base/error.h"
#include "scantet/base/quantity.h"

namespace scantet {
namespace {

TEST(BudgetOptions, DurationsAndAmountsHaveUnits) {
  EXPECT_EQ(read_duration("--max-time", "90"), 90);
  EXPECT_EQ(read_duration("--max-time", "0.5s"), 0.5);
  EXPECT_EQ(read_duration("--max-time", "10m"), 600);
  EXPECT_EQ(read_duration("--max-time", "1.5h"), 5400);
  EXPECT_EQ(read_bytes("--max-memory", "8G"), 8.0 * 1024 * 1024 * 1024);
  EXPECT_EQ(read_bytes("--max-memory", "1000"), 1000);
  EXPECT_EQ(bytes_text(8.0 * 1024 * 1024 * 1024), "8G");
  EXPECT_EQ(bytes_text(1536.0 * 1024), "1.5M");
}

TEST(Quantity, LengthsAndSharesAreTold) {
  EXPECT_EQ(read_length_or_share("--min-edge", "0.2").mm, 0.2);
  EXPECT_EQ(read_length_or_share("--min-edge", "0.2mm").mm, 0.2);
  EXPECT_EQ(read_length_or_share("--min-edge", "0.2").share, 0);
  EXPECT_DOUBLE_EQ(read_length_or_share("--min-edge", "5%").share, 0.05);
  EXPECT_EQ(read_length_or_share("--min-edge", "5%").mm, 0);
  EXPECT_EQ(read_length_or_share("--min-edge", "0").mm, 0);
  for (const char* text : {"", "-1", "%", "5x", "nan", "inf", "5 %"}) {
    EXPECT_THROW(read_length_or_share("--min-edge", text), Error) << text;
  }
}

TEST(BudgetOptions, NonsenseIsRefusedWithItsPlace) {
  BudgetOptions budget;
  OptionSet options;
  declare_budget_options(options, budget, "Run");
  for (const char* name : {"max-time", "max-memory"}) {
    for (const char* text : {"", "0", "-1", "10x", "m", "nan", "inf", "1e400", "1 0", "1e308T", "1e308h"}) {
      try {
        options.set({name, text, std::string("--") + name});
        ADD_FAILURE() << name << " " << text;
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), "usage.value") << text;
        EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
      }
    }
  }
  EXPECT_FALSE(budget.time_s());
  options.set({"max-time", "none", "--max-time"});
  EXPECT_FALSE(budget.time_s());
}

}  // namespace
}  // namespace scantet
