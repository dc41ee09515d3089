// --max-time and --max-memory: what a job may use beside vertices.
#pragma once

#include <optional>
#include <string>

#include "scantet/base/api.h"
#include "scantet/base/budget.h"
#include "scantet/base/options.h"

namespace SCANTET_PROGRAM_API scantet {

/// As typed; empty: no bound.
struct BudgetOptions {
  std::string time;
  std::string memory;

  std::optional<double> time_s() const;
  std::optional<double> memory_bytes() const;
};

/// Declares both options in the group.
void declare_budget_options(OptionSet& options, BudgetOptions& budget, const char* group);

/// "--max-time 10m was over while busy with refine R1". Pre: a budget has ended.
std::string budget_text(const BudgetOptions& options, const Budget& budget);

}  // namespace scantet
