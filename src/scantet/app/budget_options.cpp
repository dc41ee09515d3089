// The texts are read anew whenever their values are asked for; they were checked when they were typed.
#include "scantet/app/budget_options.h"

#include "scantet/base/quantity.h"

namespace scantet {

std::optional<double> BudgetOptions::time_s() const {
  return time.empty() ? std::nullopt : std::optional(read_duration("--max-time", time));
}

std::optional<double> BudgetOptions::memory_bytes() const {
  return memory.empty() ? std::nullopt : std::optional(read_bytes("--max-memory", memory));
}

void declare_budget_options(OptionSet& options, BudgetOptions& budget, const char* group) {
  options.add(
      "max-time", budget.time, Range::above(0), "or with a unit: 90s, 10m, 1.5h",
      [](const OptionValue& value) { read_duration(value.place, value.text); },
      {group, "TIME", "a duration",
       "Sampling, refinement and improvement give up after this time (wall, seconds without a unit), with exit "
       "status 4 and the mesh there is by then, if there is one. Audit, fields, second order, certification and "
       "writing follow and take their time. What is cut off by the clock is not the same in every run."});
  options.add("max-memory", budget.memory, Range::above(0), "or with a unit: 500M, 8G",
              [](const OptionValue& value) { read_bytes(value.place, value.text); },
              {group, "SIZE", "an amount of memory",
               "As --max-time, of the memory that the program holds (bytes without a unit). A size that will take more "
               "is refused before the work; without the option, one that will take more than the machine has."});
}

std::string budget_text(const BudgetOptions& options, const Budget& budget) {
  const bool is_time = budget.end() == Budget::End::time;
  return (is_time ? "--max-time " + options.time : "--max-memory " + options.memory) + " was over while busy with '" +
         budget.busy_with() + "'";
}

}  // namespace scantet
