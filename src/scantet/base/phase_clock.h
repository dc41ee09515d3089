// What a run spends its time on beside making the mesh.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/base/run_account.h"
#include "scantet/base/stopwatch.h"

namespace scantet {

/// Accounts for phases one after the other, and shows each on a Progress when it begins. For one thread.
class PhaseClock {
 public:
  /// accounts: where phases are added as they end; it and `progress` must outlive this.
  PhaseClock(std::vector<PhaseAccount>& accounts, Progress& progress) : accounts_(accounts), progress_(progress) {}
  ~PhaseClock() { end(); }
  PhaseClock(const PhaseClock&) = delete;
  PhaseClock& operator=(const PhaseClock&) = delete;

  /// From now on the work of begin() is known: `total` in the unit of its weights.
  void expect(std::uint64_t total) { total_ = total; }
  /// Ends the phase under way and begins another. weight: its share of the work expected.
  void begin(const char* stage, const std::string& part, std::uint64_t weight = 0);
  /// Ends the phase under way, if there is one.
  void end();

 private:
  std::vector<PhaseAccount>& accounts_;
  Progress& progress_;
  std::optional<PhaseAccount> current_;  // with the processor time at its begin
  Stopwatch watch_;
  std::optional<std::uint64_t> total_;
  std::uint64_t done_ = 0;
  std::uint64_t weight_ = 0;  // of the phase under way
};

}  // namespace scantet
