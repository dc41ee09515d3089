// Bounds on time and memory, in the form of a Progress.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "scantet/base/progress.h"

namespace scantet {

/// Passes everything on to another Progress. It is also cancelled when time or memory is used up, and stays so from
/// then on.
class Budget final : public Progress {
 public:
  enum class End { none, cancelled, time, memory };

  /// time_s: wall time from now on, seconds. memory_bytes: of the process, resident. None: no bound.
  /// `inner` must outlive this.
  Budget(Progress& inner, std::optional<double> time_s, std::optional<double> memory_bytes)
      : inner_(inner), time_s_(time_s), memory_bytes_(memory_bytes) {}

  void report(const ProgressState& state) override;
  bool cancelled() const override { return end() != End::none; }
  bool out_of_budget() const override;
  /// From now on time and memory do not count, if they are not used up yet.
  void close() { closed_ = true; }
  /// Why it is cancelled. If both hold, it is by the inner Progress, not by a budget.
  End end() const;
  /// The stage and step that were reported last when the budget ended: "sample", "refine R1".
  std::string busy_with() const;

 private:
  using Clock = std::chrono::steady_clock;
  bool is_memory_over(double now_s) const;

  Progress& inner_;
  std::optional<double> time_s_;
  std::optional<double> memory_bytes_;
  Clock::time_point start_ = Clock::now();
  std::atomic<bool> closed_{false};
  mutable std::atomic<End> over_{End::none};
  mutable std::atomic<double> looked_s_{-1};  // when the memory was last looked at
  mutable std::mutex mutex_;
  std::string busy_with_;
};

}  // namespace scantet
